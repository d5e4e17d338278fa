//! Fills a table on all threads, and reads it on one more thread at the same time.

use std::panic;
use std::sync::mpsc;
use std::thread::{self, ScopedJoinHandle};

use rayon::prelude::*;

/// Fills parts of `length` rows, of which the last may be shorter. `fill` is passed the index of a
/// part and its rows, and is called for the parts in order. `take` is passed the filled parts, also
/// in order, each as soon as it is filled; if no thread can be started for `take`, after all are.
/// Returns what `take` returns.
///
/// # Panics
/// If `length` is 0.
pub fn fill_while<T: Send + Sync, R: Send>(
    table: &mut [T],
    length: usize,
    fill: impl Fn(usize, &mut [T]) + Sync,
    take: impl FnOnce(&mut dyn Iterator<Item = &[T]>) -> R + Send,
) -> R {
    let channel = |part| {
        let (sender, receiver) = mpsc::channel::<&[T]>();
        ((part, sender), receiver)
    };
    let (parts, full): (Vec<_>, Vec<_>) = table.chunks_mut(length).map(channel).unzip();
    let mut taker = Some((take, full.into_iter().map_while(|part| part.recv().ok())));
    let mut taken = None;
    thread::scope(|scope| {
        let take = || taken = taker.take().map(|(take, mut parts)| take(&mut parts));
        let thread = thread::Builder::new().spawn_scoped(scope, take);
        parts.into_iter().enumerate().par_bridge().for_each(|(idx, (part, sender))| {
            fill(idx, part);
            // `take` may have ended before the last part.
            let _ = sender.send(part);
        });
        if let Ok(Err(cause)) = thread.map(ScopedJoinHandle::join) {
            panic::resume_unwind(cause);
        }
    });
    let taken = taken.or_else(|| taker.map(|(take, mut parts)| take(&mut parts)));
    taken.expect("`take` is called by the thread or after it")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_threads(n_threads: usize, work: impl FnOnce() + Send) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build();
        pool.expect("threads start").install(work);
    }

    /// The first part is filled last, and `take` reads only some of the parts, or all.
    #[test]
    fn parts_are_taken_in_order() {
        for n_threads in [1, 3] {
            on_threads(n_threads, || {
                let fill = |part: usize, rows: &mut [usize]| {
                    if part == 0 {
                        thread::sleep(std::time::Duration::from_millis(20));
                    }
                    rows.fill(part);
                };
                let mut table = [0; 30];
                let firsts = fill_while(&mut table, 4, fill, |parts| {
                    parts.map(|part| (part[0], part.len())).take(5).collect::<Vec<_>>()
                });
                assert_eq!(firsts, [(0, 4), (1, 4), (2, 4), (3, 4), (4, 4)]);
                assert_eq!(table[28..], [7, 7]);
                let all =
                    fill_while(&mut table, 4, fill, |parts| parts.flatten().copied().collect::<Vec<_>>());
                assert!(all.into_iter().eq((0..30).map(|row| row / 4)));
            });
        }
    }

    #[test]
    #[should_panic(expected = "the third part")]
    fn panics_reach_the_caller() {
        let fill = |part: usize, _: &mut [u8]| assert_ne!(part, 2, "the third part");
        fill_while(&mut [0; 40], 4, fill, |parts| parts.count());
    }
}
