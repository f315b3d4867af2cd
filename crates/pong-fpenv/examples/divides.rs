//! Divides zero by zero inside a call. Built with `--cfg pong_traps`, the program must be ended by that
//! (`ci/traps --long`).

use std::hint::black_box;

fn main() {
    let quotient = pong_fpenv::guarded(|| black_box(0.0_f64) / black_box(0.0));
    println!("{quotient}");
}
