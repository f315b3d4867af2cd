#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| pong_fuzz::scene::run(data));
