//! Energy accounts of contacts, of pairs and of the whole world.

pub mod account;
pub(crate) mod contact;
pub(crate) mod episodes;
pub(crate) mod ledger;
