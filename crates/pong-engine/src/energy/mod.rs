//! Energy accounts: what is remembered and told of the energies of contacts, pairs and the whole world.

pub mod account;
pub(crate) mod contact;
pub(crate) mod episodes;
pub(crate) mod ledger;
