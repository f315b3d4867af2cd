//! What several tests need.

use pong_engine::{Config, World, WorldBuilder};

/// A sealed world in which nothing can touch.
pub fn empty_world() -> World {
    let builder = WorldBuilder::new(Config::default());
    let (world, _) = builder.seal().unwrap();
    world
}
