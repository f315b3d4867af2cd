//! Energy accounts: of contacts, of pairs of movable groups, and the response to one that gains energy.

use super::frames::finite;
use super::session::{Session, Sure, read_text};
use pong::accounts::{
    pong_energy_account, pong_get_contact_energy_accounts, pong_get_energy_account,
    pong_get_pair_energy_account, pong_pair_energy_account, pong_pair_energy_account_count, pong_pair_remedy,
};
use std::ffi::c_char;

impl Session<'_> {
    pub fn accounts(&mut self) {
        match self.input.below(3) {
            0 => self.account(),
            1 => self.pair_account(),
            _ => self.contact_accounts(),
        }
    }

    fn account(&mut self) {
        let (world, known) = self.world();
        let place = self.place::<pong_energy_account>();
        // SAFETY: here and below: living worlds, places and texts, as the safety contract of all entries says.
        if self.call("account", known.and(place.sure), || unsafe {
            pong_get_energy_account(world, place.pointer)
        }) {
            check(&place.get());
        }
    }

    fn pair_account(&mut self) {
        let (world, known) = self.world();
        let mut count = 0;
        let counted = self
            .call("pair accounts", known, || unsafe { pong_pair_energy_account_count(world, &mut count) });
        let index = self.input.one_of(&[0, 1, 2, 3, 1000, usize::MAX]);
        let place = self.place::<pong_pair_energy_account>();
        let sure = known.and(place.sure).unless(!counted).only_if(index < count || !counted);
        if self.call("pair account", sure, || unsafe {
            pong_get_pair_energy_account(world, index, place.pointer)
        }) {
            let pair = place.get();
            check(&pair.total);
            check(&pair.episode);
            finite([pair.excess, pair.worst_excess, pair.stiffness, pair.damping].iter(), "pair account");
            assert!(
                pair.episodes_gained + pair.episodes_unresolved <= pair.episodes,
                "verdicts without an episode"
            );
        }
        let place = self.place::<*const c_char>();
        let sure = known.and(place.sure).unless(!counted).only_if(index < count || !counted);
        if self.call("remedy", sure, || unsafe { pong_pair_remedy(world, index, place.pointer) }) {
            read_text(place.get());
        }
    }

    fn contact_accounts(&mut self) {
        let (world, known) = self.world();
        let capacity = self.input.one_of(&[0, 1, 16, 5000]);
        let mut accounts = Vec::<pong_energy_account>::with_capacity(capacity);
        let place = self.place::<usize>();
        let sure = known.and(place.sure).and(Sure::Unknown);
        let done = self.call("contact accounts", sure, || unsafe {
            pong_get_contact_energy_accounts(world, accounts.as_mut_ptr(), capacity, place.pointer)
        });
        if !done {
            return;
        }
        assert!(place.get() <= capacity, "{} accounts where {capacity} fit", place.get());
        // SAFETY: the call succeeded, so this many were written.
        unsafe { accounts.set_len(place.get()) };
        accounts.iter().for_each(check);
    }
}

fn check(account: &pong_energy_account) {
    let energies = [account.work_in, account.work_out, account.inserted, account.hold_error, account.stored];
    let losses = [account.damping_loss, account.friction_loss, account.resolution];
    finite(energies.iter().chain(&losses), "account");
    assert!(account.verdict <= 2, "a verdict that there is not");
}
