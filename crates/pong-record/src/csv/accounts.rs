//! The energy accounts of a run as CSV.

use super::Look;
use super::table::{Table, csv_name};
use crate::error::LogError;
use pong_engine::{InterfaceId, World};
use std::path::Path;

const ACCOUNTS: &str = "time_s,a,b,work_in_j,work_out_j,inserted_j,hold_error_j,stored_j,damping_loss_j,friction_loss_j,\
                        resolution_j,in_contact,episodes,episodes_gained,episodes_unresolved,excess_j";

/// `accounts.csv`: energies that the contacts of each pair of movable groups received, returned, hold and
/// lost since the world began, for every pair that has touched.
#[derive(Debug)]
pub struct AccountsTable {
    table: Table,
    bodies: Vec<(InterfaceId, String)>,
}

impl AccountsTable {
    /// Begins the file in a folder, which is created if it does not exist.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn create(folder: &Path, look: &Look) -> Result<Self, LogError> {
        let names = look.run().bodies.iter().map(|body| csv_name(&body.name));
        Ok(Self {
            table: Table::create(folder, "accounts.csv", ACCOUNTS)?,
            bodies: look.capture.bodies().iter().copied().zip(names).collect(),
        })
    }

    /// Writes a line for each pair that has touched, at the last commit of the world. Writes none if it keeps
    /// no accounts.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&mut self, world: &World, time: f64) -> Result<(), LogError> {
        for pair in world.pair_accounts().filter(|pair| pair.in_contact || pair.episodes > 0) {
            self.table.begin(time);
            for interface in pair.interfaces {
                let name = self.bodies.iter().find(|(known, _)| *known == interface);
                self.table.cell(name.map_or("", |(_, name)| name));
            }
            let total = &pair.total;
            self.table.numbers(&[
                total.work_in,
                total.work_out,
                total.inserted,
                total.hold_error,
                total.stored,
            ]);
            self.table.numbers(&[total.damping_loss, total.friction_loss, total.resolution]);
            self.table.cell(u8::from(pair.in_contact));
            for number in [pair.episodes, pair.episodes_gained, pair.episodes_unresolved] {
                self.table.cell(number);
            }
            self.table.numbers(&[pair.excess]);
            self.table.end()?;
        }
        Ok(())
    }

    /// Writes the buffered rest.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(self) -> Result<(), LogError> {
        self.table.finish()
    }
}
