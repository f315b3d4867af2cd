//! The rows of a log, and accounts, as CSV. Every number is written with enough digits to read back to the
//! same bits.

mod accounts;
mod table;

pub use accounts::AccountsTable;

use crate::error::LogError;
use crate::read::Frame;
use crate::run::Run;
use crate::table::{ContactRow, EnergyRow};
use crate::write::{Capture, RecordOptions, describe};
use pong_engine::World;
use std::path::Path;
use table::Table;
pub use table::csv_name;

const STATES: &str = "time_s,body,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,\
                      wx_rad_per_s,wy_rad_per_s,wz_rad_per_s";
const WRENCHES: &str = "time_s,body,fx_n,fy_n,fz_n,mx_n_m,my_n_m,mz_n_m";
const CONTACTS: &str = "time_s,a,a_element,b,b_element,feature,end,x_m,y_m,z_m,nx,ny,nz,depth_m,rate_m_per_s,weight,\
                        normal_force_n,friction_x_n,friction_y_n,friction_z_n,\
                        slip_x_m_per_s,slip_y_m_per_s,slip_z_m_per_s,sticks,stored_j";
const ENERGIES: &str =
    "time_s,kinetic_j,potential_j,springs_j,contacts_j,contact_loss_j,spring_loss_j,work_in_j,balance_j";

/// A view of a sealed world as the rows of a log, without a log.
#[derive(Debug)]
pub struct Look {
    run: Run,
    capture: Capture,
}

impl Look {
    /// Collects the bodies, pairs and primitives that the rows refer to.
    ///
    /// # Errors
    /// Errors of the engine.
    pub fn new(world: &World) -> Result<Self, LogError> {
        let run = describe(world, Vec::new(), &RecordOptions::default())?;
        Ok(Self { run, capture: Capture::new(world, false)? })
    }

    /// Bodies, pairs and primitives that the rows refer to.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// Writes the frame last computed, with this time (s), into `frame`, whose memory is reused; its energies
    /// are not changed.
    ///
    /// # Errors
    /// A world without a frame.
    pub fn frame(&self, world: &World, time: f64, frame: &mut Frame) -> Result<(), LogError> {
        Ok(self.capture.rows(world, time, frame)?)
    }
}

/// The CSV files of a run: states, wrenches, contacts and, if wanted, energies.
#[derive(Debug)]
pub struct CsvTables {
    states: Table,
    wrenches: Table,
    contacts: Table,
    energies: Option<Table>,
    /// Names in CSV form.
    bodies: Vec<String>,
    primitives: Vec<String>,
}

impl CsvTables {
    /// Begins the files in a folder, which is created if it does not exist.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn create(folder: &Path, run: &Run, energies: bool) -> Result<Self, LogError> {
        let energies = if energies { Some(Table::create(folder, "energies.csv", ENERGIES)?) } else { None };
        let primitives = 0..run.primitives.len();
        Ok(Self {
            states: Table::create(folder, "states.csv", STATES)?,
            wrenches: Table::create(folder, "wrenches.csv", WRENCHES)?,
            contacts: Table::create(folder, "contacts.csv", CONTACTS)?,
            energies,
            bodies: run.bodies.iter().map(|body| csv_name(&body.name)).collect(),
            primitives: primitives
                .map(|index| csv_name(&run.primitive_name(index).unwrap_or_default()))
                .collect(),
        })
    }

    /// Writes a line for each body and each contact of a frame.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&mut self, frame: &Frame) -> Result<(), LogError> {
        let time = frame.row.time;
        for ((name, state), wrench) in self.bodies.iter().zip(&frame.states).zip(&frame.wrenches) {
            self.states.begin(time);
            self.states.cell(name);
            self.states.numbers(&state.position);
            self.states.numbers(&state.orientation);
            self.states.numbers(&state.linear_velocity);
            self.states.numbers(&state.angular_velocity);
            self.states.end()?;
            self.wrenches.begin(time);
            self.wrenches.cell(name);
            self.wrenches.numbers(&wrench.force);
            self.wrenches.numbers(&wrench.moment);
            self.wrenches.end()?;
        }
        frame.contacts.iter().try_for_each(|contact| self.contact(time, contact))?;
        frame.energies.as_ref().map_or(Ok(()), |energies| self.energy(time, energies))
    }

    fn contact(&mut self, time: f64, contact: &ContactRow) -> Result<(), LogError> {
        let table = &mut self.contacts;
        table.begin(time);
        for (primitive, element) in
            [(contact.primitive_a, contact.element_a), (contact.primitive_b, contact.element_b)]
        {
            table.cell(&self.primitives[primitive as usize]);
            table.cell(element);
        }
        table.cell(contact.feature_kind << 30 | contact.feature_index);
        table.cell(contact.end);
        table.numbers(&contact.point);
        table.numbers(&contact.normal);
        table.numbers(&[contact.depth, contact.depth_rate, contact.weight, contact.normal_force]);
        table.numbers(&contact.friction_force);
        table.numbers(&contact.slip_velocity);
        table.cell(contact.sticks);
        table.numbers(&[contact.stored]);
        table.end()
    }

    fn energy(&mut self, time: f64, e: &EnergyRow) -> Result<(), LogError> {
        let Some(table) = &mut self.energies else { return Ok(()) };
        table.begin(time);
        table.numbers(&[e.kinetic, e.potential, e.springs, e.contacts]);
        table.numbers(&[e.contact_loss, e.spring_loss, e.work_in, e.balance]);
        table.end()
    }

    /// Writes the buffered rest. Existing files are replaced once all of the new ones are written.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn finish(self) -> Result<(), LogError> {
        let tables = [Some(self.states), Some(self.wrenches), Some(self.contacts), self.energies];
        let mut tables: Vec<Table> = tables.into_iter().flatten().collect();
        tables.iter_mut().try_for_each(Table::flush)?;
        tables.into_iter().try_for_each(Table::finish)
    }
}
