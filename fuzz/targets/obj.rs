#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| pong_fuzz::obj::run(data));
libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    pong_fuzz::text::mutate(data, size, max_size, seed)
});
