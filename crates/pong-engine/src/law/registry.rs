//! Force laws added by the host, by name.

use super::friction::FrictionForce;
use super::normal::NormalForce;
use super::props::CombineError;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Registered force laws; the model's surfaces refer to them by name.
#[derive(Clone, Debug, Default)]
pub struct Laws {
    normal: BTreeMap<String, Arc<dyn NormalForce>>,
    friction: BTreeMap<String, Arc<dyn FrictionForce>>,
}

impl Laws {
    /// Adds a normal force law.
    pub fn add_normal(&mut self, name: &str, law: Arc<dyn NormalForce>) {
        self.normal.insert(name.to_owned(), law);
    }

    /// Adds a friction law.
    pub fn add_friction(&mut self, name: &str, law: Arc<dyn FrictionForce>) {
        self.friction.insert(name.to_owned(), law);
    }

    pub(crate) fn normal(&self, name: &str) -> Result<Arc<dyn NormalForce>, CombineError> {
        self.normal.get(name).cloned().ok_or_else(|| missing("normal force law", name))
    }

    pub(crate) fn friction(&self, name: &str) -> Result<Arc<dyn FrictionForce>, CombineError> {
        self.friction.get(name).cloned().ok_or_else(|| missing("friction law", name))
    }

    /// Name of the first friction law that `others` has under the same name with a different number of state
    /// values; `None` if there is none.
    pub(crate) fn first_of_other_state(&self, others: &Self) -> Option<&str> {
        let differs = |name: &String, law: &Arc<dyn FrictionForce>| {
            others.friction.get(name).is_some_and(|other| other.state_len() != law.state_len())
        };
        self.friction.iter().find(|(name, law)| differs(name, law)).map(|(name, _)| name.as_str())
    }

    /// Names of all laws, for the hash of a world.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.normal.keys().chain(self.friction.keys()).map(String::as_str)
    }
}

fn missing(what: &str, name: &str) -> CombineError {
    CombineError {
        cause: format!("no {what} named `{name}` is registered"),
        cure: "register it with the world before sealing".to_owned(),
    }
}
