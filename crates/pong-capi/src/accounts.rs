//! Energy accounts.

use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::ids::{pong_interface_id, pong_pair_id};
use crate::interfaces::too_small;
use crate::names::{c_text, no_such};
use crate::pointers::{Out, OutArray, apart};
use crate::status::pong_status;
use pong_engine::{EnergyAccount, PairEnergyAccount, Verdict, World};
use std::ffi::c_char;

/// Verdict on an energy account: PONG_VERDICT_...
pub type pong_verdict = u32;

/// `verdict`: less energy came out than went in.
pub const PONG_VERDICT_DISSIPATED: pong_verdict = 0;
/// `verdict`: as much energy came out as went in, as far as the accounts can tell.
pub const PONG_VERDICT_UNRESOLVED: pong_verdict = 1;
/// `verdict`: more energy came out than went in.
pub const PONG_VERDICT_GAINED: pong_verdict = 2;

/// Energies, J. To rounding  work_in + inserted + hold_error = work_out + stored + damping_loss + friction_loss.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_energy_account {
    /// Energy that the bodies gave: work of the wrench on them, where it was negative.
    pub work_in: f64,
    /// Energy that the bodies got back: work of the wrench on them, where it was positive.
    pub work_out: f64,
    /// Energy stored without work: where the host put bodies into each other, less what it cleared. For a
    /// contact that began while its pair was already in contact: energy taken over from another contact.
    pub inserted: f64,
    /// Error of holding the wrench: its work less that of the force as it would have followed the motion.
    pub hold_error: f64,
    /// Stored in normal springs and friction now.
    pub stored: f64,
    /// Lost in normal damping.
    pub damping_loss: f64,
    /// Lost in friction.
    pub friction_loss: f64,
    /// Uncertainty of `work_out - work_in`, rounding apart; 0 except with PONG_COUPLING_STAGES.
    pub resolution: f64,
    /// Verdict: PONG_VERDICT_...
    pub verdict: pong_verdict,
    /// Zero.
    pub reserved: u32,
}

/// Accounts of two movable groups. A contact episode lasts from their first contact until they no longer
/// touch and no delayed wrench is pending.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_pair_energy_account {
    /// The pair of Objects.
    pub pair: pong_pair_id,
    /// The two movable groups.
    pub interfaces: [pong_interface_id; 2],
    /// Since the world began.
    pub total: pong_energy_account,
    /// Account of the contact episode in progress; zero if there is none.
    pub episode: pong_energy_account,
    /// 1: an episode is in progress. 0: none is.
    pub in_contact: i32,
    /// 1: an episode, over or not, has gained energy; remedy: pong_pair_remedy(). 0: none has.
    pub gains_energy: i32,
    /// Episodes that have ended.
    pub episodes: u64,
    /// Ended episodes that gained energy.
    pub episodes_gained: u64,
    /// Ended episodes whose accounts leave it open.
    pub episodes_unresolved: u64,
    /// Energy gained in all episodes together, J.
    pub excess: f64,
    /// Most energy gained in one episode, J.
    pub worst_excess: f64,
    /// Stiffness of the stiffest contact that the two can have, N/m; 0 if it depends on the depth.
    pub stiffness: f64,
    /// Damping of that contact, N s/m.
    pub damping: f64,
}

/// Copies the accounts of all pairs together at the last commit; zero unless the configuration has
/// energy_accounts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_energy_account(
    world: *const pong_world,
    account: *mut pong_energy_account,
) -> pong_status {
    get(world, (account, "account"), |inner| {
        Ok((&inner.phase.sealed().map_or_else(EnergyAccount::default, World::account)).into())
    })
}

/// Number of pairs of movable groups for which accounts are kept; 0 unless the configuration has
/// energy_accounts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_pair_energy_account_count(
    world: *const pong_world,
    count: *mut usize,
) -> pong_status {
    get(world, (count, "count"), |inner| Ok(inner.pair_accounts().count()))
}

/// Copies the accounts of a pair of movable groups at the last commit, always in the same order; `index` counts
/// from 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_pair_energy_account(
    world: *const pong_world,
    index: usize,
    account: *mut pong_pair_energy_account,
) -> pong_status {
    get(world, (account, "account"), |inner| {
        let count = inner.pair_accounts().count();
        let found = inner.pair_accounts().nth(index);
        Ok((&found.ok_or_else(|| no_such("pair account", index, count))?).into())
    })
}

/// Returns a remedy for a pair of movable groups that gains energy, in words with the numbers of the pair;
/// `index` as for pong_get_pair_energy_account(). The text lives until the next call of this function for the
/// world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_pair_remedy(
    world: *const pong_world,
    index: usize,
    remedy: *mut *const c_char,
) -> pong_status {
    get(world, (remedy, "remedy"), |inner| {
        let count = inner.pair_accounts().count();
        let found = inner.pair_accounts().nth(index);
        let found = found.ok_or_else(|| no_such("pair account", index, count))?;
        inner.remedy = c_text(&found.remedy());
        Ok(inner.remedy.as_ptr())
    })
}

/// Copies the accounts of the contacts of the last frame, each since the contact began, in the order of
/// pong_get_contacts(): the first `capacity`; `count` gets their number, which is 0 unless the configuration
/// has energy_accounts. PONG_STATUS_BUFFER_TOO_SMALL if not all fit. With capacity 0 `accounts` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_contact_energy_accounts(
    world: *const pong_world,
    accounts: *mut pong_energy_account,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        apart(("accounts", accounts, capacity), ("count", count, 1))?;
        let (mut out, count) = (OutArray::new(accounts, capacity, "accounts")?, Out::new(count, "count")?);
        inner.law_faults.check()?;
        let listed = inner.phase.sealed().into_iter().flat_map(World::contact_accounts).enumerate();
        listed.take(capacity).for_each(|(index, account)| out.set(index, (&account).into()));
        let kept = inner.phase.scene().wrench_coupling().is_some();
        let total = if kept { inner.phase.report().contacts as usize } else { 0 };
        count.set(total);
        too_small("accounts", capacity, total)
    })
}

impl Inner {
    /// Accounts of all pairs; empty before the seal.
    fn pair_accounts(&self) -> impl Iterator<Item = PairEnergyAccount> + '_ {
        self.phase.sealed().into_iter().flat_map(World::pair_accounts)
    }
}

impl From<&EnergyAccount> for pong_energy_account {
    fn from(account: &EnergyAccount) -> Self {
        Self {
            work_in: account.work_in,
            work_out: account.work_out,
            inserted: account.inserted,
            hold_error: account.hold_error,
            stored: account.stored,
            damping_loss: account.damping_loss,
            friction_loss: account.friction_loss,
            resolution: account.resolution,
            verdict: match account.verdict() {
                Verdict::Dissipated => PONG_VERDICT_DISSIPATED,
                Verdict::Unresolved => PONG_VERDICT_UNRESOLVED,
                Verdict::Gained => PONG_VERDICT_GAINED,
            },
            reserved: 0,
        }
    }
}

impl From<&PairEnergyAccount> for pong_pair_energy_account {
    fn from(account: &PairEnergyAccount) -> Self {
        let (stiffness, damping) = account.stiffest.unwrap_or_default();
        Self {
            pair: account.pair.into(),
            interfaces: account.interfaces.map(Into::into),
            total: (&account.total).into(),
            episode: (&account.episode).into(),
            in_contact: account.in_contact.into(),
            gains_energy: account.gains_energy().into(),
            episodes: account.episodes,
            episodes_gained: account.episodes_gained,
            episodes_unresolved: account.episodes_unresolved,
            excess: account.excess,
            worst_excess: account.worst_excess,
            stiffness,
            damping,
        }
    }
}
