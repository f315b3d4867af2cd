//! Kept results in the output folder, so that a study that was stopped goes on where it was.
//!
//! Every file is named by a hash of all that determines its contents, and is written atomically.

use crate::sweep::record::Record;
use crate::{Result, StudyError};
use pong_model::files;
use serde::{Serialize, de::DeserializeOwned};
use std::path::{Path, PathBuf};

/// The folder of kept results.
pub(crate) struct Store {
    folder: PathBuf,
}

impl Store {
    /// Opens the folder `kept` of an output folder, and creates both if they do not exist.
    pub fn open(output: &Path, fresh: bool) -> Result<Self> {
        let folder = output.join("kept");
        if fresh && folder.exists() {
            std::fs::remove_dir_all(&folder).map_err(|reason| StudyError::output(&folder, reason))?;
        }
        std::fs::create_dir_all(&folder).map_err(|reason| StudyError::output(&folder, reason))?;
        Ok(Self { folder })
    }

    fn path(&self, kind: &str, key: u64, ending: &str) -> PathBuf {
        self.folder.join(format!("{kind}_{key:016x}.{ending}"))
    }

    /// The result kept under a key; `None` if there is none or it cannot be read.
    pub fn get<T: DeserializeOwned>(&self, kind: &str, key: u64) -> Option<T> {
        let text = files::read_text(&self.path(kind, key, "json")).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// Keeps a result under a key.
    pub fn put<T: Serialize>(&self, kind: &str, key: u64, value: &T) -> Result<()> {
        let path = self.path(kind, key, "json");
        let text = serde_json::to_string(value).map_err(|reason| StudyError::output(&path, reason))?;
        write_whole(&path, text.as_bytes())
    }

    /// A record kept under a key.
    pub fn record(&self, key: u64) -> Option<Record> {
        read_record(&files::read(&self.path("record", key, "bin")).ok()?)
    }

    /// Keeps a record under a key.
    pub fn put_record(&self, key: u64, record: &Record) -> Result<()> {
        write_whole(&self.path("record", key, "bin"), &record_bytes(record))
    }
}

/// Writes a file atomically: complete or not at all.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    files::replace(path, bytes).map_err(|reason| StudyError::output(path, reason))
}

/// Little-endian words: bodies, instants in a frame, incomplete steps, number of rows' values; then all
/// numbers.
fn record_bytes(record: &Record) -> Vec<u8> {
    let head = [
        record.bodies as u64,
        record.per_frame.into(),
        record.incomplete,
        record.rows.len() as u64,
        record.energy_change.to_bits(),
        record.energy_scale.to_bits(),
    ];
    let numbers = record.rows.iter().chain(record.impulses.iter().flatten());
    let numbers = numbers.chain(record.efforts.iter().flatten()).chain(record.peaks.iter().flatten());
    let words = head.into_iter().chain(numbers.map(|x| x.to_bits()));
    words.flat_map(u64::to_le_bytes).collect()
}

fn read_record(bytes: &[u8]) -> Option<Record> {
    let (words, rest) = bytes.as_chunks::<8>();
    let words: Vec<u64> = words.iter().map(|word| u64::from_le_bytes(*word)).collect();
    let [bodies, per_frame, incomplete, rows, change, scale, numbers @ ..] = &words[..] else { return None };
    let (bodies, rows) = (usize::try_from(*bodies).ok()?, usize::try_from(*rows).ok()?);
    if !rest.is_empty() || numbers.len() != rows.checked_add(bodies.checked_mul(10)?)? {
        return None;
    }
    let numbers: Vec<f64> = numbers.iter().map(|word| f64::from_bits(*word)).collect();
    let (rows, sums) = numbers.split_at(rows);
    let (impulses, sums) = sums.split_at(6 * bodies);
    let (efforts, peaks) = sums.split_at(2 * bodies);
    Some(Record {
        bodies,
        per_frame: u32::try_from(*per_frame).ok()?,
        incomplete: *incomplete,
        energy_change: f64::from_bits(*change),
        energy_scale: f64::from_bits(*scale),
        rows: rows.to_vec(),
        impulses: impulses.as_chunks().0.to_vec(),
        efforts: efforts.as_chunks().0.to_vec(),
        peaks: peaks.as_chunks().0.to_vec(),
    })
}

/// Serialises a number that may be infinite, which JSON cannot represent, as null.
pub(crate) mod number {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        number.is_finite().then_some(*number).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}

/// Serialises five such numbers.
pub(crate) mod numbers {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(numbers: &[f64; 5], serializer: S) -> Result<S::Ok, S::Error> {
        numbers.map(|number| number.is_finite().then_some(number)).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 5], D::Error> {
        Ok(<[Option<f64>; 5]>::deserialize(deserializer)?.map(|number| number.unwrap_or(f64::INFINITY)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::errors::Errors;

    #[test]
    fn records_come_back_with_the_same_bits() {
        let record = Record {
            bodies: 2,
            per_frame: 4,
            rows: (0..52).map(|k| f64::from(k) / 3.0).collect(),
            impulses: vec![[0.1; 6], [0.2; 6]],
            efforts: vec![[0.3, 0.4], [f64::MIN_POSITIVE, 5e-324]],
            peaks: vec![[0.5, 0.6], [0.7, -0.0]],
            energy_change: 1.0 / 7.0,
            energy_scale: 2.0 / 7.0,
            incomplete: 3,
        };
        let bytes = record_bytes(&record);
        assert_eq!(read_record(&bytes).unwrap(), record);
        assert_eq!(read_record(&bytes[..bytes.len() - 8]), None, "cut off");
        assert_eq!(read_record(&[]), None);
    }

    #[test]
    fn infinite_errors_come_back() {
        let errors = Errors::new([0.1 + 0.2, f64::INFINITY, 0.0, 1e-300, 5.0]);
        let text = serde_json::to_string(&errors).unwrap();
        assert_eq!(serde_json::from_str::<Errors>(&text).unwrap(), errors, "{text}");
    }
}
