//! Gives the shared library the name under which programs look for it, which cargo does not.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    match std::env::var("CARGO_CFG_TARGET_OS").as_deref() {
        // The number is `PONG_ABI_VERSION`.
        Ok("linux") => println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libpong.so.1"),
        // Rust names the file by its place on the machine that builds it.
        Ok("macos") => println!("cargo:rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libpong.dylib"),
        _ => {}
    }
}
