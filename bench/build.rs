//! Builds what stands between the benchmarks and engines in C, where their features are on.
//!
//! `MUJOCO_DIR` names the folder that holds MuJoCo's `include/` and library, as its wheel unpacks them.

use std::env::var;

fn main() {
    println!("cargo:rerun-if-changed=shim");
    #[cfg(feature = "mujoco")]
    mujoco(&var("MUJOCO_DIR").expect("MUJOCO_DIR: `bash bench/run` sets it"));
    #[cfg(feature = "ode")]
    ode();
    _ = var("OUT_DIR");
}

#[cfg(feature = "mujoco")]
fn mujoco(folder: &str) {
    println!("cargo:rerun-if-env-changed=MUJOCO_DIR");
    cc::Build::new().file("shim/mujoco.c").include(format!("{folder}/include")).compile("pong_mujoco");
    let library = std::fs::read_dir(folder)
        .expect("MUJOCO_DIR is a folder")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .find(|name| name.starts_with("libmujoco.so"))
        .expect("MUJOCO_DIR holds libmujoco.so");
    println!("cargo:rustc-link-search={folder}");
    println!("cargo:rustc-link-lib=dylib:+verbatim={library}");
    println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
}

#[cfg(feature = "ode")]
fn ode() {
    cc::Build::new().file("shim/ode.c").compile("pong_ode");
    println!("cargo:rustc-link-lib=ode");
}
