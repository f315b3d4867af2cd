//! Prints `pong.h`: `cargo run -p pong-capi --example generate_header > include/pong.h`.

#[path = "../tests/it/support/header.rs"]
mod header;

fn main() {
    print!("{}", header::generate());
}
