//! Energies: of a frame, and of all committed frames together (docs/theory.md, 6).
//!
//! | energy | computed in | when | from |
//! |---|---|---|---|
//! | stored, of a contact | `../frame/forces` | every frame | normal spring and bristle |
//! | work and dissipation of a contact, and their sum: the *ledger* | `balance.rs` | every frame, if `Config::ledger` is set | force at the last commit and now, `displacement.rs` |
//! | the same by cause, of a contact: an *account* | `accounts.rs` | every frame, if `Config::accounts` is set | as the ledger; and the wrench as the host applies it |
//! | account of a pair of movable groups | `accounts.rs` | end of the frame | sum over its contacts, or its delayed wrench |
//! | account and verdict of a *contact episode* | `episodes.rs` | end of the frame | account of the pair |
//!
//! The frame writes to `buffers.rs`. A commit copies the energies into the contact state: `contact.rs`
//! (contacts), `episodes.rs` (pairs) and `LedgerEntry` (sums). `account.rs` is the public form of an account.

pub mod account;
mod accounts;
pub(crate) mod balance;
pub(crate) mod buffers;
pub(crate) mod contact;
mod displacement;
pub(crate) mod episodes;

/// Work and dissipation of a frame, or of all frames since the world began: of all contacts, or of those of one
/// pair of movable groups.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LedgerEntry {
    /// Work done on the bodies, J.
    pub work: f64,
    /// Energy dissipated or dropped, J.
    pub dissipated: f64,
}

impl LedgerEntry {
    pub fn add(&mut self, other: &Self) {
        self.work += other.work;
        self.dissipated += other.dissipated;
    }
}
