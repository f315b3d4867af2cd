//! The text of measured data: a line for each body and time, columns by name, settings in lines that begin
//! with `#` (docs/fit.md).

use super::record::{Data, Quantity, Record, Row};
use crate::error::{FitError, Result};
use pong_geometry::{Quat, Vec3};

const COLUMNS: [&str; 22] = [
    "record", "time", "body", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz",
    "fx", "fy", "fz", "mx", "my", "mz",
];

/// Groups of columns that belong together.
const GROUPS: [&[&str]; 6] = [
    &["x", "y", "z"],
    &["qw", "qx", "qy", "qz"],
    &["vx", "vy", "vz"],
    &["wx", "wy", "wz"],
    &["fx", "fy", "fz"],
    &["mx", "my", "mz"],
];

/// Largest deviation of a quaternion's norm from 1.
const NORM_ERROR_MAX: f64 = 1e-2;

/// Largest number of faults of a file that are reported.
const FAULTS_MAX: usize = 20;

/// Reads data from text; errors call it `file`.
///
/// # Errors
/// Every fault of the text, each with its line, cause and cure.
pub fn parse(text: &str, file: &str, bodies: &[String]) -> Result<Data> {
    let mut reader = Reader { file, bodies, faults: Vec::new(), data: Data::default(), columns: Vec::new() };
    for (number, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        reader.line(number + 1, line.trim());
    }
    if reader.columns.is_empty() && reader.faults.is_empty() {
        reader.fault(
            1,
            "the file has no line with the names of the columns",
            format!("begin with {}", COLUMNS.join(",")),
        );
    }
    if reader.data.records.is_empty() && reader.faults.is_empty() {
        reader.fault(1, "the file has no measurement", "give a line for each body and time");
    }
    if reader.faults.is_empty() {
        return Ok(reader.data);
    }
    let more = reader.faults.len().saturating_sub(FAULTS_MAX);
    reader.faults.truncate(FAULTS_MAX);
    if more > 0 {
        reader.faults.push(format!("{file}: {more} more faults; correct these first"));
    }
    Err(FitError(reader.faults.join("\n")))
}

struct Reader<'a> {
    file: &'a str,
    bodies: &'a [String],
    faults: Vec<String>,
    data: Data,
    /// Index in [`COLUMNS`] of each column of the file.
    columns: Vec<usize>,
}

impl Reader<'_> {
    fn fault(&mut self, line: usize, cause: impl std::fmt::Display, cure: impl std::fmt::Display) {
        self.faults.push(format!("{}:{line}: {cause}; {cure}", self.file));
    }

    fn line(&mut self, number: usize, line: &str) {
        if line.is_empty() {
            return;
        }
        if let Some(setting) = line.strip_prefix('#') {
            return self.setting(number, setting.trim());
        }
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if self.columns.is_empty() {
            self.heading(number, &cells);
        } else if self.columns == [usize::MAX] {
            // The heading is at fault, so that its lines cannot be judged.
        } else if cells.len() != self.columns.len() {
            let cause = format!("the line has {} cells for {} columns", cells.len(), self.columns.len());
            self.fault(number, cause, "leave a cell empty for what was not measured");
        } else {
            self.measurement(number, &cells);
        }
    }

    /// A setting, `noise.position = 0.0005`. Other lines that begin with `#` are comments.
    fn setting(&mut self, number: usize, text: &str) {
        let Some((name, value)) = text.split_once('=').map(|(name, value)| (name.trim(), value.trim()))
        else {
            return;
        };
        if let Some(quantity) = name.strip_prefix("noise.") {
            let Some(known) = Quantity::ALL.into_iter().find(|known| known.name() == quantity) else {
                let names = Quantity::ALL.map(Quantity::name).join(", ");
                return self.fault(
                    number,
                    format!("there is no quantity `{quantity}`"),
                    format!("name one of: {names}"),
                );
            };
            match value.parse::<f64>() {
                Ok(noise) if noise > 0.0 && noise.is_finite() => {
                    self.data.noise[known as usize] = Some(noise)
                }
                _ => {
                    let cure = format!(
                        "give the standard deviation of one axis, a number above zero, {}",
                        known.unit()
                    );
                    self.fault(number, format!("the noise of {quantity} is `{value}`"), cure);
                }
            }
        } else if name == "angular_velocity" {
            match value {
                "body" => self.data.along_body = true,
                "common" => self.data.along_body = false,
                other => {
                    let cause = format!("the axes of the angular velocity are `{other}`");
                    self.fault(
                        number,
                        cause,
                        "write body (axes of the body) or common (axes of the common frame)",
                    );
                }
            }
        }
    }

    fn heading(&mut self, number: usize, cells: &[&str]) {
        let mut columns = Vec::new();
        if let [cell] = cells
            && let Some(separator) = cell.chars().find(|sign| [';', '\t', ' '].contains(sign))
        {
            self.columns = vec![usize::MAX];
            let cause = format!("its columns are separated by {separator:?}");
            return self.fault(number, cause, "separate them by commas, and write decimals with a point");
        }
        for cell in cells {
            match COLUMNS.iter().position(|known| known == cell) {
                Some(place) if columns.contains(&place) => {
                    self.fault(number, format!("column `{cell}` is given twice"), "keep one of them");
                }
                Some(place) => columns.push(place),
                None => {
                    let cure = format!("name columns among: {}", COLUMNS.join(", "));
                    self.fault(number, format!("there is no column `{cell}`"), cure);
                }
            }
        }
        let has = |name: &str| columns.iter().any(|place| COLUMNS[*place] == name);
        if !has("time") {
            self.fault(number, "there is no column `time`", "give the time of each line, s");
        }
        for group in GROUPS {
            let (there, missing): (Vec<&str>, Vec<&str>) = group.iter().partition(|name| has(name));
            if !there.is_empty() && !missing.is_empty() {
                let cause = format!("columns {} are there, {} are not", there.join(", "), missing.join(", "));
                self.fault(number, cause, "give all columns of a quantity");
            }
        }
        if !has("body") && self.bodies.len() != 1 {
            let cure = format!("name one of: {}", self.bodies.join(", "));
            self.fault(number, "there is no column `body`, and the scene has several free bodies", cure);
        }
        self.columns = columns;
        if !self.faults.is_empty() {
            self.columns = vec![usize::MAX];
        }
    }

    fn measurement(&mut self, number: usize, cells: &[&str]) {
        let cell = |name: &str| {
            let place = self.columns.iter().position(|place| COLUMNS[*place] == name)?;
            Some(cells[place]).filter(|text| !text.is_empty())
        };
        let (record, body) = (cell("record").unwrap_or("1").to_owned(), cell("body").map(str::to_owned));
        let mut parsed: Vec<Result<Option<Vec<f64>>, String>> = Vec::new();
        for group in std::iter::once(["time"].as_slice()).chain(GROUPS) {
            parsed.push(numbers(&group.iter().map(|name| (*name, cell(name))).collect::<Vec<_>>()));
        }
        let mut values = Vec::new();
        for group in parsed {
            match group {
                Ok(group) => values.push(group),
                Err(cause) => {
                    return self.fault(
                        number,
                        cause,
                        "give finite numbers, or leave all cells of the quantity empty",
                    );
                }
            }
        }
        let Some(time) = values[0].as_ref().map(|time| time[0]) else {
            return self.fault(number, "the line has no time", "give it in s");
        };
        let body = match body.or_else(|| (self.bodies.len() == 1).then(|| self.bodies[0].clone())) {
            Some(body) if self.bodies.contains(&body) => body,
            named => {
                let cause = named
                    .map_or("the line names no body".to_owned(), |name| format!("there is no body `{name}`"));
                return self.fault(number, cause, format!("name one of: {}", self.bodies.join(", ")));
            }
        };
        let orientation = match self.orientation(number, values[2].as_deref()) {
            Ok(orientation) => orientation,
            Err(()) => return,
        };
        let vector =
            |place: usize| values[place].as_ref().map(|numbers: &Vec<f64>| Vec3::from_column_slice(numbers));
        let mut angular_velocity = vector(4);
        if self.data.along_body {
            match (angular_velocity, orientation) {
                (Some(along_body), Some(orientation)) => angular_velocity = Some(orientation * along_body),
                (Some(_), None) => {
                    let cause = "an angular velocity along the axes of the body has no orientation beside it";
                    return self.fault(number, cause, "give the orientation in the same line");
                }
                (None, _) => {}
            }
        }
        let row = Row {
            time: 0,
            body,
            position: vector(1),
            orientation,
            velocity: vector(3),
            angular_velocity,
            force: vector(5),
            moment: vector(6),
        };
        self.add(number, &record, time, row);
    }

    fn orientation(&mut self, number: usize, wxyz: Option<&[f64]>) -> Result<Option<Quat>, ()> {
        let Some(&[w, x, y, z]) = wxyz else { return Ok(None) };
        let norm = (w * w + x * x + y * y + z * z).sqrt();
        if (norm - 1.0).abs() > NORM_ERROR_MAX {
            self.fault(
                number,
                format!("the quaternion has norm {norm:.4}"),
                "give unit quaternions qw, qx, qy, qz",
            );
            return Err(());
        }
        Ok(Some(pong_geometry::Pose::new(Vec3::zeros(), [w, x, y, z]).orientation))
    }

    /// Adds a row to its record, which is the last one or a new one.
    fn add(&mut self, number: usize, name: &str, time: f64, row: Row) {
        let records = &mut self.data.records;
        if records.last().is_none_or(|last| last.name != name) {
            if records.iter().any(|earlier| earlier.name == name) {
                let cause = format!("record `{name}` goes on after another one");
                return self.fault(number, cause, "put all lines of a record together");
            }
            records.push(Record { name: name.to_owned(), ..Record::default() });
        }
        let record = records.last_mut().expect("one was pushed");
        match record.times.last() {
            Some(last) if time < *last => {
                let cause = format!(
                    "the time {time} s of record `{name}` is before that of the line above, {last} s"
                );
                return self.fault(number, cause, "sort the lines by time");
            }
            Some(last) if time == *last => {}
            _ => record.times.push(time),
        }
        let row = Row { time: record.times.len() - 1, ..row };
        if record
            .rows
            .iter()
            .rev()
            .take_while(|other| other.time == row.time)
            .any(|other| other.body == row.body)
        {
            let cause = format!("record `{name}` has body `{}` twice at {time} s", row.body);
            return self.fault(number, cause, "keep one of the lines, or name the record of each");
        }
        record.rows.push(row);
    }
}

/// Numbers of a group of cells; `None` if all cells are empty.
fn numbers(cells: &[(&str, Option<&str>)]) -> Result<Option<Vec<f64>>, String> {
    if cells.iter().all(|(_, cell)| cell.is_none()) {
        return Ok(None);
    }
    let number = |(name, cell): &(&str, Option<&str>)| {
        let text = cell.unwrap_or_default();
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| format!("`{name}` is `{text}`"))
    };
    cells.iter().map(number).collect::<Result<Vec<_>, _>>().map(Some)
}
