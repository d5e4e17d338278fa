//! Parallel loops over the rows of a table (a slice, or row numbers), with short compile times.
//!
//! A chain of rayon's iterators is compiled anew for every closure and every element type, about
//! 0.2 s each. Here rayon is instantiated for one closure type only: a function of a range of rows.
//! Everything generic is a plain loop inside that function. It is called through a pointer once per
//! range, not once per row, so run time does not suffer.
//!
//! ```
//! let squares = ugparallel::map(1_000_000, 1 << 14, |row| row * row);
//! assert_eq!(squares[1000], 1_000_000);
//! ```
//!
//! Results are in the order of the rows, for any number of threads. `least` is the least number of
//! rows in a range. A table of fewer than two such ranges is processed by the calling thread alone,
//! because waking another one would take longer.

use std::collections::BTreeMap;
use std::ops::Range;
use std::panic;
use std::sync::mpsc::{self, Receiver};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, ScopedJoinHandle};

use rayon::prelude::*;

/// Ranges per thread: several, so that idle threads take over ranges of busy ones.
const RANGES_PER_THREAD: usize = 8;

/// Number of threads.
pub fn n_threads() -> usize {
    rayon::current_num_threads()
}

/// Changes each row of a table. `change` is passed the row's index too.
pub fn for_each_mut<T: Send>(table: &mut [T], least: usize, change: impl Fn(usize, &mut T) + Sync) {
    let ranges = Ranges::new(table.len(), least);
    let change_all = |first: usize, rows: &mut [T]| {
        rows.iter_mut().enumerate().for_each(|(idx, row)| change(first + idx, row));
    };
    if ranges.n_ranges <= 1 {
        return change_all(0, table);
    }
    let mut rest = table;
    let mut parts = Vec::with_capacity(ranges.n_ranges);
    for idx in 0..ranges.n_ranges {
        let (part, behind) = rest.split_at_mut(ranges.range(idx).len());
        parts.push(Mutex::new(part));
        rest = behind;
    }
    run_all(parts.len(), &|idx| change_all(ranges.range(idx).start, &mut lock(&parts[idx])));
}

/// Calls `work` for each element of `jobs`. Threads take one job at a time, which balances jobs of
/// different length.
pub fn for_jobs<T: Send>(jobs: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    let jobs: Vec<Mutex<&mut T>> = jobs.iter_mut().map(Mutex::new).collect();
    run_all(jobs.len(), &|idx| work(idx, &mut lock(&jobs[idx])));
}

/// Like `for_jobs`; meanwhile, the calling thread runs `meanwhile`. Returns the value of
/// `meanwhile`.
pub fn for_jobs_while<T: Send, R>(
    jobs: &mut [T],
    work: impl Fn(usize, &mut T) + Sync,
    meanwhile: impl FnOnce() -> R,
) -> R {
    let jobs: Vec<Mutex<&mut T>> = jobs.iter_mut().map(Mutex::new).collect();
    let job = |idx: usize| work(idx, &mut lock(&jobs[idx]));
    rayon::in_place_scope(|scope| {
        scope.spawn(|_| run_all(jobs.len(), &job));
        meanwhile()
    })
}

/// Fills a table on all threads, and reads it on one more thread at the same time.
///
/// The table is divided into parts of `length` rows; the last may be shorter. `fill` is passed the
/// index of a part and its rows, and is called for the parts in order. `take` is passed an iterator
/// over the filled parts, also in order, which waits until the next part is filled. If no thread
/// can be started for `take`, it is called after all parts are filled. Returns what `take` returns.
///
/// # Panics
/// If `length` is 0.
pub fn fill_while<T: Send + Sync, R: Send>(
    table: &mut [T],
    length: usize,
    fill: impl Fn(usize, &mut [T]) + Sync,
    take: impl FnOnce(FullParts<'_, T>) -> R + Send,
) -> R {
    let parts = Mutex::new(table.chunks_mut(length).enumerate());
    let (sender, receiver) = mpsc::channel();
    let mut taker = Some((take, FullParts { receiver, next: 0, early: BTreeMap::new() }));
    let mut taken = None;
    thread::scope(|scope| {
        let take = || taken = taker.take().map(|(take, parts)| take(parts));
        let thread = thread::Builder::new().spawn_scoped(scope, take);
        run_all(n_threads(), &|_| {
            loop {
                let next = lock(&parts).next();
                let Some((idx, part)) = next else { break };
                fill(idx, part);
                // `take` may have ended before the last part.
                let _ = sender.send((idx, part));
            }
        });
        // No more parts will come.
        drop(sender);
        if let Ok(Err(cause)) = thread.map(ScopedJoinHandle::join) {
            panic::resume_unwind(cause);
        }
    });
    let taken = taken.or_else(|| taker.map(|(take, parts)| take(parts)));
    taken.expect("`take` is called by the thread or after it")
}

/// The parts of a table in order. `next` waits until the part is filled.
pub struct FullParts<'t, T> {
    receiver: Receiver<(usize, &'t mut [T])>,
    next: usize,
    /// Parts that were filled before the one that `next` waits for.
    early: BTreeMap<usize, &'t [T]>,
}

impl<'t, T> Iterator for FullParts<'t, T> {
    type Item = &'t [T];

    fn next(&mut self) -> Option<&'t [T]> {
        loop {
            if let Some(part) = self.early.remove(&self.next) {
                self.next += 1;
                return Some(part);
            }
            let (idx, part) = self.receiver.recv().ok()?;
            self.early.insert(idx, part);
        }
    }
}

/// A table of what `row` returns for each of `0..n_rows`.
pub fn map<R: Send>(n_rows: usize, least: usize, row: impl Fn(usize) -> R + Sync) -> Vec<R> {
    collect(n_rows, least, |range, table| table.extend(range.map(&row)))
}

/// A table that `append` fills: it is passed a range of rows, and appends any number of results for
/// each row. The results of all ranges are concatenated in order.
pub fn collect<R: Send>(
    n_rows: usize,
    least: usize,
    append: impl Fn(Range<usize>, &mut Vec<R>) + Sync,
) -> Vec<R> {
    let ranges = Ranges::new(n_rows, least);
    let parts: Vec<Mutex<Vec<R>>> = (0..ranges.n_ranges).map(|_| Mutex::default()).collect();
    let append = |idx: usize| append(ranges.range(idx), &mut lock(&parts[idx]));
    match parts.len() {
        1 => append(0),
        n_ranges => run_all(n_ranges, &append),
    }
    let mut parts = parts.into_iter().map(|part| part.into_inner().unwrap_or_else(PoisonError::into_inner));
    let Some(mut table) = parts.next() else {
        return Vec::new();
    };
    let parts: Vec<Vec<R>> = parts.collect();
    table.reserve_exact(parts.iter().map(Vec::len).sum());
    for mut part in parts {
        table.append(&mut part);
    }
    table
}

/// The indices of the rows for which `test` holds, in order.
pub fn positions(n_rows: usize, least: usize, test: impl Fn(usize) -> bool + Sync) -> Vec<usize> {
    collect(n_rows, least, |range, rows| rows.extend(range.filter(|&row| test(row))))
}

/// Rows cut into ranges of nearly one length.
#[derive(Clone, Copy)]
struct Ranges {
    n_rows: usize,
    n_ranges: usize,
}

impl Ranges {
    fn new(n_rows: usize, least: usize) -> Self {
        let most = if n_threads() == 1 { 1 } else { RANGES_PER_THREAD * n_threads() };
        Self { n_rows, n_ranges: (n_rows / least.max(1)).clamp(usize::from(n_rows > 0), most) }
    }

    fn range(self, idx: usize) -> Range<usize> {
        // In u128, since the product may not fit.
        let start = |idx: usize| (idx as u128 * self.n_rows as u128 / self.n_ranges as u128) as usize;
        start(idx)..start(idx + 1)
    }
}

/// The one place where rayon splits work.
fn run_all(n_jobs: usize, job: &(dyn Fn(usize) + Sync)) {
    (0..n_jobs).into_par_iter().with_max_len(1).for_each(job);
}

/// Each part is locked only by the thread that works on it, so locking never blocks.
fn lock<T: ?Sized>(part: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    part.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [usize; 6] = [0, 1, 15, 16, 33, 10_007];

    fn on_threads(n_threads: usize, work: impl FnOnce() + Send) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build();
        pool.expect("threads start").install(work);
    }

    #[test]
    fn ranges_are_all_rows_once_in_order() {
        for n_threads in [1, 3] {
            on_threads(n_threads, || {
                for n_rows in SIZES {
                    let ranges = Ranges::new(n_rows, 16);
                    let rows: Vec<usize> = (0..ranges.n_ranges).flat_map(|idx| ranges.range(idx)).collect();
                    assert!(rows.into_iter().eq(0..n_rows), "{n_rows} rows on {n_threads} threads");
                    let is_long = |idx| ranges.range(idx).len() >= n_rows.min(16);
                    assert!((0..ranges.n_ranges).all(is_long), "{n_rows} rows on {n_threads} threads");
                }
            });
        }
    }

    /// The first part is filled last, and `take` reads only some of the parts.
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
            });
        }
    }

    #[test]
    #[should_panic(expected = "the third part")]
    fn panics_reach_the_caller() {
        let fill = |part: usize, _: &mut [u8]| assert_ne!(part, 2, "the third part");
        fill_while(&mut [0; 40], 4, fill, |parts| parts.count());
    }

    #[test]
    fn tables_are_those_of_a_plain_loop() {
        for n_threads in [1, 2, 5] {
            on_threads(n_threads, || {
                for n_rows in SIZES {
                    let squares: Vec<usize> = (0..n_rows).map(|row| row * row).collect();
                    assert_eq!(map(n_rows, 16, |row| row * row), squares);
                    let mut table: Vec<usize> = (0..n_rows).collect();
                    for_each_mut(&mut table, 16, |row, value| *value *= row);
                    assert_eq!(table, squares);
                    let twice = collect(n_rows, 16, |rows, out| out.extend(rows.flat_map(|row| [row, row])));
                    assert!(twice.into_iter().eq((0..2 * n_rows).map(|idx| idx / 2)));
                    let thirds: Vec<usize> = (0..n_rows).step_by(3).collect();
                    assert_eq!(positions(n_rows, 16, |row| row % 3 == 0), thirds);
                    let mut jobs = squares.clone();
                    for_jobs(&mut jobs, |idx, job| *job += idx);
                    assert!(jobs.iter().enumerate().all(|(idx, job)| *job == squares[idx] + idx));
                    let mut jobs = squares.clone();
                    let end = for_jobs_while(&mut jobs, |idx, job| *job += idx, || 7);
                    assert_eq!(end, 7);
                    assert!(jobs.iter().enumerate().all(|(idx, job)| *job == squares[idx] + idx));
                    let mut table = vec![0; n_rows];
                    let fill = |part: usize, rows: &mut [usize]| {
                        rows.iter_mut().enumerate().for_each(|(idx, row)| *row = 7 * part + idx);
                    };
                    let taken =
                        fill_while(&mut table, 7, fill, |parts| parts.flatten().copied().collect::<Vec<_>>());
                    assert!(taken.into_iter().eq(0..n_rows));
                    assert!(table.into_iter().eq(0..n_rows));
                }
            });
        }
    }
}
