//! events.jsonl: the host's changes between frames.

use crate::error::LogError;
use pong_model::{Exponent, FrictionLaw, NormalLaw, Surface};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Name of the file.
pub(crate) const FILE: &str = "events.jsonl";

/// An event and the frame that it belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoggedEvent {
    /// The first frame evaluated after the event.
    pub frame: u64,
    /// The event.
    #[serde(flatten)]
    pub event: Event,
}

/// An event between frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// A pair was switched on or off.
    Pair {
        /// Index of the pair.
        pair: u32,
        /// True if it is tested from now on.
        enabled: bool,
    },
    /// The contact history of an Object was cleared (`forget` in version 1).
    #[serde(alias = "forget")]
    ClearContactHistory {
        /// Index of the Object.
        object: u32,
    },
    /// The values of a surface were replaced.
    Surface {
        /// Index of the model.
        model: u32,
        /// Name of the surface.
        name: String,
        /// Its values.
        #[serde(flatten)]
        values: SurfaceValues,
    },
    /// The motion of the surface of a movable group along itself was set.
    SurfaceMotion {
        /// Index of the movable group, as in the table of states.
        body: u32,
        /// Velocities: linear, m/s, angular, rad/s, and belt, m/s.
        velocity: [[f64; 3]; 3],
        /// Travels: linear, m, angular, rad, and belt, m.
        travel: [[f64; 3]; 3],
    },
    /// A contact state was restored.
    Restore {
        /// File of the block, in the folder of the log.
        file: String,
    },
    /// The frame of this number was committed for these pairs only.
    Commit {
        /// Indices of the pairs.
        pairs: Vec<u32>,
    },
    /// Events that were lost because they came faster than they could be written.
    Lost {
        /// Their number.
        count: u64,
    },
    /// An event that this program does not know.
    #[serde(other)]
    Unknown,
}

/// The values of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceValues {
    /// Stiffness, N/m, or N/m^1.5; may be infinite.
    #[serde(with = "number")]
    stiffness: f64,
    /// Foundation modulus, N/m³, if the surface gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    foundation: Option<f64>,
    /// Area of the stiffness, m², if the surface gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    area: Option<f64>,
    #[serde(with = "Normal")]
    normal: NormalLaw,
    #[serde(with = "Friction")]
    friction: FrictionLaw,
}

/// A normal law in the notation of logs.
#[derive(Serialize, Deserialize)]
#[serde(remote = "NormalLaw", tag = "law")]
enum Normal {
    Linear {
        damping: f64,
        ramp: f64,
    },
    HuntCrossley {
        dissipation: f64,
        #[serde(rename = "hertz", with = "hertz")]
        exponent: Exponent,
    },
    PowerLaw {
        damping: f64,
        #[serde(rename = "hertz", with = "hertz")]
        exponent: Exponent,
        damping_exponent: f64,
    },
    Custom {
        name: String,
        parameters: Vec<f64>,
    },
    Inherited,
}

/// A friction law in the notation of logs.
#[derive(Serialize, Deserialize)]
#[serde(remote = "FrictionLaw", tag = "law")]
enum Friction {
    None,
    Bristle {
        mu: f64,
        static_excess: f64,
        stiffness: Option<f64>,
        damping: Option<f64>,
        #[serde(default, skip_serializing_if = "is_zero")]
        rolling: f64,
        #[serde(default, skip_serializing_if = "is_zero")]
        spinning: f64,
    },
    Coulomb {
        mu: f64,
        slip_speed: f64,
    },
    Custom {
        name: String,
        parameters: Vec<f64>,
    },
    Inherited,
}

/// Returns true for a resistance that a surface does not have.
fn is_zero(length: &f64) -> bool {
    *length == 0.0
}

impl From<&Surface> for SurfaceValues {
    fn from(surface: &Surface) -> Self {
        let Surface { name: _, stiffness, foundation, area, normal, friction } = surface.clone();
        Self { stiffness, foundation, area, normal, friction }
    }
}

impl SurfaceValues {
    /// The surface with these values.
    pub fn surface(&self, name: &str) -> Surface {
        let Self { stiffness, foundation, area, normal, friction } = self.clone();
        Surface { name: name.to_owned(), stiffness, foundation, area, normal, friction }
    }
}

/// Serialises the exponent as a flag: true for Hertz.
mod hertz {
    use pong_model::Exponent;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(exponent: &Exponent, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bool(*exponent == Exponent::ThreeHalves)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Exponent, D::Error> {
        Ok(if bool::deserialize(deserializer)? { Exponent::ThreeHalves } else { Exponent::One })
    }
}

/// Serialises numbers that may be infinite, which JSON cannot represent.
mod number {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Written {
        Number(f64),
        Text(String),
    }

    pub fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        if number.is_finite() { number.serialize(serializer) } else { serializer.serialize_str("inf") }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        match Written::deserialize(deserializer)? {
            Written::Number(number) => Ok(number),
            Written::Text(text) if text == "inf" => Ok(f64::INFINITY),
            Written::Text(text) => Err(D::Error::custom(format!("{text:?} is neither a number nor \"inf\""))),
        }
    }
}

/// Reads the events of a log; an incomplete last line is skipped.
pub(crate) fn load(folder: &Path) -> Result<Vec<LoggedEvent>, LogError> {
    let path = folder.join(FILE);
    let text = match pong_model::files::read_text(&path) {
        Ok(text) => text,
        Err(reason) if reason.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(reason) => return Err(LogError::unreadable(&path, &reason)),
    };
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    let lines = whole.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let read = |(number, line): (usize, &str)| {
        let damaged =
            |error: serde_json::Error| LogError::damaged(&path, format!("line {}: {error}", number + 1));
        serde_json::from_str(line).map_err(damaged)
    };
    lines.map(read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_come_back_with_the_same_bits() {
        let laws = [
            (
                NormalLaw::Linear { damping: 0.1 + 0.2, ramp: 1e-300 },
                FrictionLaw::Bristle {
                    mu: 1.0 / 3.0,
                    static_excess: 0.1,
                    stiffness: None,
                    damping: Some(5e-324),
                    rolling: 1e-3 / 3.0,
                    spinning: 0.0,
                },
            ),
            (
                NormalLaw::HuntCrossley { dissipation: 2.0 / 3.0, exponent: Exponent::ThreeHalves },
                FrictionLaw::Coulomb { mu: 0.7, slip_speed: 1e-3 },
            ),
            (
                NormalLaw::Custom { name: "mine".to_owned(), parameters: vec![0.3] },
                FrictionLaw::Bristle {
                    mu: 0.2,
                    static_excess: 0.0,
                    stiffness: Some(1e5),
                    damping: None,
                    rolling: 0.0,
                    spinning: 0.1 + 0.2,
                },
            ),
            (
                NormalLaw::PowerLaw {
                    damping: 1e7 / 3.0,
                    exponent: Exponent::ThreeHalves,
                    damping_exponent: 0.1 + 0.2,
                },
                FrictionLaw::None,
            ),
        ];
        let numbers = [
            (f64::INFINITY, None, None),
            (1e5 / 3.0, Some(1e8 / 3.0), None),
            (1.0, None, Some(0.1 + 0.2)),
            (1e9, None, None),
        ];
        for ((normal, friction), (stiffness, foundation, area)) in laws.into_iter().zip(numbers) {
            let surface = Surface { name: "s".to_owned(), stiffness, foundation, area, normal, friction };
            let event = Event::Surface { model: 0, name: "s".to_owned(), values: (&surface).into() };
            let text = serde_json::to_string(&LoggedEvent { frame: 3, event }).unwrap();
            let read: LoggedEvent = serde_json::from_str(&text).unwrap();
            let Event::Surface { name, values, .. } = read.event else { panic!("{text}") };
            assert_eq!(values.surface(&name), surface, "{text}");
        }
    }

    #[test]
    fn an_event_of_a_later_version_is_known_as_such() {
        let read: LoggedEvent = serde_json::from_str(r#"{"frame": 1, "event": "shiver", "by": 2}"#).unwrap();
        assert_eq!(read.event, Event::Unknown);
    }
}
