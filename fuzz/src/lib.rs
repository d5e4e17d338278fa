//! What the fuzz targets for files share: the generators of hostile inputs of the tests.

use std::sync::Once;

use libfuzzer_sys::fuzzer_mutate;
use rayon::ThreadPoolBuilder;
use ugtesting::Random;
use ugtests::hostile::{File, damage};

/// Fails if something does not hold of the file.
pub fn check(file: File, bytes: &[u8]) {
    static BEGUN: Once = Once::new();
    // Handing small work to another thread takes longer than the work.
    BEGUN.call_once(|| {
        let built = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global();
        built.unwrap_or_else(|error| panic!("one thread: {error}"));
    });
    if let Err(finding) = file.check(bytes) {
        panic!("{finding}");
    }
}

/// The next input: mostly a mutation of libFuzzer, sometimes damage of the kinds that files get,
/// and rarely a new file. Returns its size; `bytes` has the largest size, and the input is its
/// head.
pub fn mutate(file: File, bytes: &mut [u8], size: usize, seed: u32) -> usize {
    let mut random = Random(seed.into());
    let mut input = match random.below(40) {
        0 => file.generate(&mut random),
        1..=6 => {
            let mut input = bytes[..size].to_vec();
            damage(&mut random, &mut input);
            input
        }
        _ => {
            let max_size = bytes.len();
            return fuzzer_mutate(bytes, size, max_size);
        }
    };
    input.truncate(bytes.len());
    bytes[..input.len()].copy_from_slice(&input);
    input.len()
}

/// The target for a kind of file.
#[macro_export]
macro_rules! target {
    ($file:expr) => {
        libfuzzer_sys::fuzz_target!(|bytes: &[u8]| $crate::check($file, bytes));
        libfuzzer_sys::fuzz_mutator!(|bytes: &mut [u8],
                                      size: usize,
                                      max_size: usize,
                                      seed: u32| {
            $crate::mutate($file, &mut bytes[..max_size], size, seed)
        });
    };
}
