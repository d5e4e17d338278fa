//! Draws several frames at the same time and passes them on in the order of the film.

use std::collections::BTreeMap;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use rayon::ThreadPoolBuilder;
use ugpipe::Failure;

struct State<T> {
    /// The row that is taken next.
    next: usize,
    /// Number of results passed to the consumer.
    n_consumed: usize,
    ready: BTreeMap<usize, Result<T, Failure>>,
    is_stopped: bool,
}

/// Computes `n_rows` results and consumes them in order, on this thread. Each thread works on one
/// row with a pool of its own, and waits when it is so far ahead that results would fill memory.
/// Where this thread is the only worker of the process, it computes the rows itself: for more
/// threads there is not enough address space. Ends at the first row that fails, after all rows
/// before it were consumed.
///
/// # Errors
/// The error of the first row that fails, or of `consume`.
pub fn in_order<T: Send>(
    n_rows: usize,
    compute: impl Fn(usize) -> Result<T, Failure> + Sync,
    mut consume: impl FnMut(usize, T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    if rayon::current_thread_index().is_some() {
        return one_by_one(n_rows, compute, consume);
    }
    let n_threads = rayon::current_num_threads();
    let n_workers = n_threads.min(n_rows).max(1);
    let state = Mutex::new(State { next: 0, n_consumed: 0, ready: BTreeMap::new(), is_stopped: false });
    let changed = Condvar::new();
    let work = || {
        // This thread is one of the pool, so that a worker needs no other if there are enough frames.
        // Without threads of its own a worker uses those of the process.
        let pool = ThreadPoolBuilder::new().num_threads(n_threads / n_workers).use_current_thread();
        let pool = pool.build().ok();
        loop {
            let mut now = lock(&state);
            while !now.is_stopped && now.next < n_rows && now.next >= now.n_consumed + 2 * n_workers {
                now = changed.wait(now).unwrap_or_else(PoisonError::into_inner);
            }
            if now.is_stopped || now.next >= n_rows {
                return;
            }
            let row = now.next;
            now.next += 1;
            drop(now);
            let result = match &pool {
                Some(pool) => pool.install(|| compute(row)),
                None => compute(row),
            };
            lock(&state).ready.insert(row, result);
            changed.notify_all();
        }
    };
    thread::scope(|scope| {
        let start = |_| thread::Builder::new().spawn_scoped(scope, work).ok();
        if (0..n_workers).map_while(start).count() == 0 {
            // The system starts no thread.
            return one_by_one(n_rows, &compute, consume);
        }
        let mut outcome = Ok(());
        for row in 0..n_rows {
            let result = {
                let mut now = lock(&state);
                loop {
                    match now.ready.remove(&row) {
                        Some(result) => break result,
                        None => now = changed.wait(now).unwrap_or_else(PoisonError::into_inner),
                    }
                }
            };
            outcome = result.and_then(|value| consume(row, value));
            let mut now = lock(&state);
            now.n_consumed = row + 1;
            now.is_stopped = outcome.is_err();
            drop(now);
            changed.notify_all();
            if outcome.is_err() {
                break;
            }
        }
        outcome
    })
}

/// Computes and consumes the rows on this thread.
fn one_by_one<T>(
    n_rows: usize,
    compute: impl Fn(usize) -> Result<T, Failure>,
    mut consume: impl FnMut(usize, T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    (0..n_rows).try_for_each(|row| consume(row, compute(row)?))
}

fn lock<T>(state: &Mutex<State<T>>) -> MutexGuard<'_, State<T>> {
    // A panic cannot leave the state inconsistent.
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn results_come_in_order_and_few_wait() {
        let (n_done, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let mut seen = Vec::new();
        let compute = |row: usize| {
            n_done.fetch_add(1, Ordering::SeqCst);
            Ok(row * row)
        };
        in_order(500, compute, |row, value| {
            most.fetch_max(n_done.load(Ordering::SeqCst) - row, Ordering::SeqCst);
            seen.push(value);
            Ok(())
        })
        .unwrap();
        assert_eq!(seen, (0..500).map(|row| row * row).collect::<Vec<_>>());
        assert!(most.into_inner() <= 3 * rayon::current_num_threads() + 1);
    }

    #[test]
    fn the_only_worker_of_the_process_starts_no_thread() {
        let id = || thread::current().id();
        let alone = || {
            let consume = |_, worker| {
                assert_eq!(worker, id());
                Ok(())
            };
            in_order(3, |_| Ok(id()), consume).unwrap();
        };
        ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(alone);
    }

    #[test]
    fn the_first_failure_ends_the_work() {
        let mut seen = Vec::new();
        let compute = |row: usize| if row == 7 { Err(Failure::failed("broken")) } else { Ok(row) };
        let outcome = in_order(1000, compute, |row, _| {
            seen.push(row);
            Ok(())
        });
        assert_eq!(outcome.unwrap_err().to_string(), "broken");
        assert_eq!(seen, [0, 1, 2, 3, 4, 5, 6]);
    }
}
