//! Models from files and texts, straight into a world in set-up.

use crate::{Error, ModelId, WorldBuilder};
use std::path::Path;
use std::sync::Arc;

/// Loading of models into a [`WorldBuilder`].
///
/// ```
/// use pong::{Config, Load, WorldBuilder};
///
/// # fn main() -> Result<(), pong::Error> {
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/examples")).unwrap();
/// let mut builder = WorldBuilder::new(Config::default());
/// let ball = builder.load("ball.ron")?;
/// builder.create_object(ball, "first ball")?;
/// builder.create_object(ball, "second ball")?;
/// # Ok(())
/// # }
/// ```
pub trait Load {
    /// Loads a model file and adds the model. Meshes are read from the folder of the file and from folders
    /// that [`WorldBuilder::allow_files_below`] allows. One model serves any number of Objects.
    ///
    /// # Errors
    /// [`Error::Model`] if the file cannot be read, and for a text that is no model: all faults, with file,
    /// line, column and cure. The builder is unchanged then.
    fn load(&mut self, path: impl AsRef<Path>) -> Result<ModelId, Error>;

    /// Loads a model from a text and adds the model. Errors call it `name`. Meshes in files of their own are
    /// refused.
    ///
    /// # Errors
    /// [`Error::Model`] with all faults. The builder is unchanged then.
    fn load_text(&mut self, text: &str, name: &str) -> Result<ModelId, Error>;
}

impl Load for WorldBuilder {
    fn load(&mut self, path: impl AsRef<Path>) -> Result<ModelId, Error> {
        let model = pong_model::load(path.as_ref(), self.scene().extensions())?;
        Ok(self.add_model(Arc::new(model)))
    }

    fn load_text(&mut self, text: &str, name: &str) -> Result<ModelId, Error> {
        let model = pong_model::parse(text, name, None, self.scene().extensions())?;
        Ok(self.add_model(Arc::new(model)))
    }
}
