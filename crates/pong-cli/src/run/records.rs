//! CSV files of a run. Every number is written so that it reads back to the same bits.

use pong_engine::{Contact, ContactSide, EngineError};
use pong_executive::scene::BuiltScene;
use pong_executive::{Simulation, Vec3};
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

/// One CSV file.
struct Table {
    path: PathBuf,
    out: BufWriter<File>,
}

/// The open files of a run.
pub(super) struct Records {
    states: Table,
    wrenches: Table,
    contacts: Table,
    energies: Option<Table>,
    line: String,
}

impl Records {
    pub fn create(folder: &Path, built: &BuiltScene) -> Result<Self, String> {
        std::fs::create_dir_all(folder).map_err(|reason| failed(folder, &reason))?;
        let energies =
            if built.ledger { Some(Table::create(folder, "energies.csv", ENERGIES)?) } else { None };
        Ok(Self {
            states: Table::create(folder, "states.csv", STATES)?,
            wrenches: Table::create(folder, "wrenches.csv", WRENCHES)?,
            contacts: Table::create(folder, "contacts.csv", CONTACTS)?,
            energies,
            line: String::new(),
        })
    }

    /// One record: a line for each body, body and contact.
    pub fn write(&mut self, simulation: &Simulation) -> Result<(), String> {
        let time = simulation.time();
        for (id, body) in simulation.bodies() {
            let (pose, twist) = (simulation.pose(id), simulation.twist(id));
            let q = &pose.orientation;
            self.begin(time);
            self.text(&body.name);
            self.numbers(pose.position.as_slice());
            self.numbers(&[q.w, q.i, q.j, q.k]);
            self.numbers(twist.linear.as_slice());
            self.numbers(twist.angular.as_slice());
            self.states.line(&self.line)?;
            let wrench = simulation.contact_wrench(id);
            self.begin(time);
            self.text(&body.name);
            self.numbers(wrench.force.as_slice());
            self.numbers(wrench.moment.as_slice());
            self.wrenches.line(&self.line)?;
        }
        if simulation.world().contact_count() > 0 {
            for contact in simulation.world().contacts() {
                self.contact(simulation, &contact)?;
            }
        }
        self.energy(simulation)
    }

    fn contact(&mut self, simulation: &Simulation, contact: &Contact) -> Result<(), String> {
        self.begin(simulation.time());
        for side in [&contact.a, &contact.b] {
            let path = primitive_path(simulation, side).map_err(|error| error.to_string())?;
            self.text(&path);
            let _ = write!(self.line, ",{}", side.element);
        }
        let _ = write!(self.line, ",{},{}", contact.feature, contact.end);
        let vector = |records: &mut Self, v: &Vec3| records.numbers(v.as_slice());
        vector(self, &contact.point);
        vector(self, &contact.normal);
        self.numbers(&[contact.depth, contact.rate, contact.weight, contact.normal_force]);
        vector(self, &contact.friction_force);
        vector(self, &contact.slip_velocity);
        let _ = write!(self.line, ",{}", u8::from(contact.sticks));
        self.numbers(&[contact.stored]);
        self.contacts.line(&self.line)
    }

    fn energy(&mut self, simulation: &Simulation) -> Result<(), String> {
        if self.energies.is_none() {
            return Ok(());
        }
        let e = simulation.energy();
        self.begin(simulation.time());
        self.numbers(&[
            e.kinetic,
            e.potential,
            e.springs,
            e.contacts,
            e.contact_loss,
            e.spring_loss,
            e.work_in,
        ]);
        self.numbers(&[e.balance()]);
        self.energies.as_mut().map_or(Ok(()), |table| table.line(&self.line))
    }

    /// Writes out what is still in memory.
    pub fn finish(self) -> Result<(), String> {
        let tables = [Some(self.states), Some(self.wrenches), Some(self.contacts), self.energies];
        tables
            .into_iter()
            .flatten()
            .try_for_each(|mut table| table.out.flush().map_err(|reason| failed(&table.path, &reason)))
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

    fn text(&mut self, text: &str) {
        self.line.push(',');
        if text.contains([',', '"', '\n']) {
            let _ = write!(self.line, "\"{}\"", text.replace('"', "\"\""));
        } else {
            self.line.push_str(text);
        }
    }
}

/// `object/path of the primitive`.
fn primitive_path(simulation: &Simulation, side: &ContactSide) -> Result<String, EngineError> {
    let world = simulation.world();
    let object = world.object_name(side.object)?;
    Ok(format!("{object}/{}", world.primitive_path(side.interface, side.primitive)?))
}

impl Table {
    fn create(folder: &Path, name: &str, heading: &str) -> Result<Self, String> {
        let path = folder.join(name);
        let file = File::create(&path).map_err(|reason| failed(&path, &reason))?;
        let mut table = Self { path, out: BufWriter::new(file) };
        table.line(heading)?;
        Ok(table)
    }

    fn line(&mut self, line: &str) -> Result<(), String> {
        writeln!(self.out, "{line}").map_err(|reason| failed(&self.path, &reason))
    }
}

fn failed(path: &Path, reason: &std::io::Error) -> String {
    format!("{}: cannot be written: {reason}; name another folder with -o", path.display())
}
