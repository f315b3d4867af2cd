//! Prints `pong.h`: `cargo run -p pong-capi --example generate_header > include/pong.h`.

#[path = "../tests/it/support/header/mod.rs"]
mod header;

fn main() {
    print!("{}", header::generate());
}
