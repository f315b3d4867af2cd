//! Gives the shared library its SONAME, which cargo does not.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        // The number is `PONG_ABI_VERSION`.
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libpong.so.1");
    }
}
