//! The rows of a log as CSV. Every number is written so that it reads back to the same bits.

use crate::error::LogError;
use crate::read::Frame;
use crate::run::Run;
use crate::table::{ContactRow, EnergyRow};
use crate::write::{Capture, RecordOptions, describe};
use pong_engine::World;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

const STATES: &str = "time_s,body,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,\
                      wx_rad_per_s,wy_rad_per_s,wz_rad_per_s";
const WRENCHES: &str = "time_s,body,fx_n,fy_n,fz_n,mx_n_m,my_n_m,mz_n_m";
const CONTACTS: &str = "time_s,a,a_element,b,b_element,feature,end,x_m,y_m,z_m,nx,ny,nz,depth_m,rate_m_per_s,weight,\
                        normal_force_n,friction_x_n,friction_y_n,friction_z_n,\
                        slip_x_m_per_s,slip_y_m_per_s,slip_z_m_per_s,sticks,stored_j";
const ENERGIES: &str =
    "time_s,kinetic_j,potential_j,springs_j,contacts_j,contact_loss_j,spring_loss_j,work_in_j,balance_j";

/// A sealed world seen as the rows of a log, without a log.
#[derive(Debug)]
pub struct Look {
    run: Run,
    capture: Capture,
}

impl Look {
    /// Gathers what the rows refer to.
    ///
    /// # Errors
    /// A world that is not sealed.
    pub fn new(world: &World) -> Result<Self, LogError> {
        let run = describe(world, Vec::new(), &RecordOptions::default())?;
        Ok(Self { run, capture: Capture::new(world, false)? })
    }

    /// What the rows refer to.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The frame last computed, of this time (s). The memory of `frame` is used again, its energies are left alone.
    ///
    /// # Errors
    /// A world without a frame.
    pub fn frame(&self, world: &World, time: f64, frame: &mut Frame) -> Result<(), LogError> {
        Ok(self.capture.rows(world, time, frame)?)
    }
}

/// One CSV file.
#[derive(Debug)]
struct Table {
    path: PathBuf,
    out: BufWriter<File>,
}

/// The CSV files of a run: states, wrenches, contacts and, if wanted, energies.
#[derive(Debug)]
pub struct CsvTables {
    states: Table,
    wrenches: Table,
    contacts: Table,
    energies: Option<Table>,
    line: String,
    /// Names as CSV writes them.
    bodies: Vec<String>,
    primitives: Vec<String>,
}

impl CsvTables {
    /// Begins the files in a folder, which is made if it is not there.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn create(folder: &Path, run: &Run, energies: bool) -> Result<Self, LogError> {
        std::fs::create_dir_all(folder).map_err(|reason| LogError::unwritable(folder, &reason))?;
        let energies = if energies { Some(Table::create(folder, "energies.csv", ENERGIES)?) } else { None };
        let primitives = 0..run.primitives.len();
        Ok(Self {
            states: Table::create(folder, "states.csv", STATES)?,
            wrenches: Table::create(folder, "wrenches.csv", WRENCHES)?,
            contacts: Table::create(folder, "contacts.csv", CONTACTS)?,
            energies,
            line: String::new(),
            bodies: run.bodies.iter().map(|body| quoted(&body.name)).collect(),
            primitives: primitives
                .map(|index| quoted(&run.primitive_name(index).unwrap_or_default()))
                .collect(),
        })
    }

    /// A line for each body and each contact of a frame.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&mut self, frame: &Frame) -> Result<(), LogError> {
        let time = frame.row.time;
        for body in 0..self.bodies.len() {
            let (state, wrench) = (&frame.states[body], &frame.wrenches[body]);
            self.begin(time);
            self.text(|own| &own.bodies[body]);
            self.numbers(&state.position);
            self.numbers(&state.orientation);
            self.numbers(&state.linear_velocity);
            self.numbers(&state.angular_velocity);
            self.states.line(&self.line)?;
            self.begin(time);
            self.text(|own| &own.bodies[body]);
            self.numbers(&wrench.force);
            self.numbers(&wrench.moment);
            self.wrenches.line(&self.line)?;
        }
        frame.contacts.iter().try_for_each(|contact| self.contact(time, contact))?;
        frame.energies.as_ref().map_or(Ok(()), |energies| self.energy(time, energies))
    }

    fn contact(&mut self, time: f64, contact: &ContactRow) -> Result<(), LogError> {
        self.begin(time);
        for (primitive, element) in
            [(contact.primitive_a, contact.element_a), (contact.primitive_b, contact.element_b)]
        {
            self.text(|own| &own.primitives[primitive as usize]);
            let _ = write!(self.line, ",{element}");
        }
        let feature = contact.feature_kind << 30 | contact.feature_index;
        let _ = write!(self.line, ",{feature},{}", contact.end);
        self.numbers(&contact.point);
        self.numbers(&contact.normal);
        self.numbers(&[contact.depth, contact.rate, contact.weight, contact.normal_force]);
        self.numbers(&contact.friction_force);
        self.numbers(&contact.slip_velocity);
        let _ = write!(self.line, ",{}", contact.sticks);
        self.numbers(&[contact.stored]);
        self.contacts.line(&self.line)
    }

    fn energy(&mut self, time: f64, e: &EnergyRow) -> Result<(), LogError> {
        self.begin(time);
        self.numbers(&[e.kinetic, e.potential, e.springs, e.contacts]);
        self.numbers(&[e.contact_loss, e.spring_loss, e.work_in, e.balance]);
        self.energies.as_mut().map_or(Ok(()), |table| table.line(&self.line))
    }

    /// Writes out what is still in memory.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn finish(self) -> Result<(), LogError> {
        let tables = [Some(self.states), Some(self.wrenches), Some(self.contacts), self.energies];
        let mut tables = tables.into_iter().flatten();
        tables.try_for_each(|mut table| {
            table.out.flush().map_err(|reason| LogError::unwritable(&table.path, &reason))
        })
    }

    fn begin(&mut self, time: f64) {
        self.line.clear();
        let _ = write!(self.line, "{time:?}");
    }

    fn numbers(&mut self, values: &[f64]) {
        for value in values {
            let _ = write!(self.line, ",{value:?}");
        }
    }

    fn text(&mut self, text: impl Fn(&Self) -> &str) {
        let mut line = std::mem::take(&mut self.line);
        line.push(',');
        line.push_str(text(self));
        self.line = line;
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

impl Table {
    fn create(folder: &Path, name: &str, heading: &str) -> Result<Self, LogError> {
        let path = folder.join(name);
        let file = File::create(&path).map_err(|reason| LogError::unwritable(&path, &reason))?;
        let mut table = Self { path, out: BufWriter::new(file) };
        table.line(heading)?;
        Ok(table)
    }

    fn line(&mut self, line: &str) -> Result<(), LogError> {
        writeln!(self.out, "{line}").map_err(|reason| LogError::unwritable(&self.path, &reason))
    }
}
