//! Draws several frames at the same time and passes them on in the order of the film.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;

use rayon::ThreadPoolBuilder;
use ugpipe::Failure;

/// Computes `n_rows` results, at most `most` at the same time, and consumes them in order, on this
/// thread. Each thread works on one row with a pool of its own, and waits when it is so far ahead
/// that results would fill memory. Where this thread is the only worker of the process, it computes
/// the rows itself: for more threads there is not enough address space. Ends at the first row that
/// fails, after all rows before it were consumed.
///
/// # Errors
/// The error of the first row that fails, or of `consume`.
pub fn in_order<T: Send>(
    (n_rows, most): (usize, usize),
    compute: impl Fn(usize) -> Result<T, Failure> + Sync,
    mut consume: impl FnMut(usize, T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    if rayon::current_thread_index().is_some() {
        return one_by_one(n_rows, compute, consume);
    }
    let n_threads = rayon::current_num_threads();
    let n_workers = n_threads.min(n_rows).min(most).max(1);
    // Rows to compute, each with the sender of its result.
    let (orders, waiting) = mpsc::channel::<(usize, mpsc::Sender<_>)>();
    let waiting = Mutex::new(waiting);
    let work = || {
        // This thread is one of the pool, so that a worker needs no other if there are enough
        // frames. Without threads of its own a worker uses those of the process.
        let pool = ThreadPoolBuilder::new().num_threads(n_threads / n_workers).use_current_thread();
        let pool = pool.build().ok();
        let next = || lock(&waiting).recv();
        while let Ok((row, sender)) = next() {
            let result = match &pool {
                Some(pool) => pool.install(|| compute(row)),
                None => compute(row),
            };
            // A row before it may have ended the film.
            let _ = sender.send(result);
        }
    };
    thread::scope(|scope| {
        let start = |_| thread::Builder::new().spawn_scoped(scope, work).ok();
        if (0..n_workers).map_while(start).count() == 0 {
            // The system starts no thread.
            return one_by_one(n_rows, &compute, consume);
        }
        let order = |row| {
            let (sender, result) = mpsc::channel();
            // The receiver exists until all is done.
            let _ = orders.send((row, sender));
            result
        };
        let mut rows = 0..n_rows;
        let mut ordered: VecDeque<_> = rows.by_ref().take(2 * n_workers).map(order).collect();
        let mut outcome = Ok(());
        for row in 0..n_rows {
            // There is no result if a worker panics, and the scope passes the panic on.
            let Some(Ok(result)) = ordered.pop_front().map(|result| result.recv()) else { break };
            outcome = result.and_then(|value| consume(row, value));
            if outcome.is_err() {
                break;
            }
            ordered.extend(rows.next().map(order));
        }
        drop(orders);
        // Of a film that has ended early, rows are left.
        lock(&waiting).try_iter().for_each(drop);
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

fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
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
        in_order((500, usize::MAX), compute, |row, value| {
            most.fetch_max(n_done.load(Ordering::SeqCst) - row, Ordering::SeqCst);
            seen.push(value);
            Ok(())
        })
        .unwrap();
        assert_eq!(seen, (0..500).map(|row| row * row).collect::<Vec<_>>());
        assert!(most.into_inner() <= 3 * rayon::current_num_threads() + 1);
    }

    #[test]
    fn no_more_are_computed_at_once() {
        let (n_running, highest) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let compute = |_| {
            highest.fetch_max(1 + n_running.fetch_add(1, Ordering::SeqCst), Ordering::SeqCst);
            thread::sleep(std::time::Duration::from_millis(1));
            n_running.fetch_sub(1, Ordering::SeqCst);
            Ok(())
        };
        in_order((30, 1), compute, |_, ()| Ok(())).unwrap();
        assert_eq!(highest.into_inner(), 1);
    }

    #[test]
    fn the_only_worker_of_the_process_starts_no_thread() {
        let id = || thread::current().id();
        let alone = || {
            let consume = |_, worker| {
                assert_eq!(worker, id());
                Ok(())
            };
            in_order((3, usize::MAX), |_| Ok(id()), consume).unwrap();
        };
        ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(alone);
    }

    #[test]
    fn the_first_failure_ends_the_work() {
        let mut seen = Vec::new();
        let compute = |row: usize| if row == 7 { Err(Failure::failed("broken")) } else { Ok(row) };
        let outcome = in_order((1000, usize::MAX), compute, |row, _| {
            seen.push(row);
            Ok(())
        });
        assert_eq!(outcome.unwrap_err().to_string(), "broken");
        assert_eq!(seen, [0, 1, 2, 3, 4, 5, 6]);
    }
}
