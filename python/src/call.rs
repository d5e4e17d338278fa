//! A computation without the interpreter lock, which an interrupt stops.

use std::panic::resume_unwind;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use ugpipe::{Host, Progress};

/// Time between two checks for interrupts and two reports of progress.
const POLL: Duration = Duration::from_millis(50);

/// Stack of the thread that computes: that of the main thread of a program.
const STACK: usize = 8 << 20;

/// A running computation.
#[derive(Default)]
pub struct Call {
    is_stopped: AtomicBool,
    step: Mutex<(&'static str, u64)>,
    done: AtomicU64,
    notes: Mutex<Vec<String>>,
}

impl Progress for Call {
    fn step(&self, name: &'static str, parts: u64) {
        *lock(&self.step) = (name, parts);
        self.done.store(0, Ordering::Relaxed);
    }

    fn done(&self, parts: u64) {
        self.done.fetch_add(parts, Ordering::Relaxed);
    }

    fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

impl Host for Call {
    fn message(&self, text: &str) {
        lock(&self.notes).push(text.to_owned());
    }
}

impl Call {
    /// The notes so far, which are removed.
    pub fn take_notes(&self) -> Vec<String> {
        std::mem::take(&mut lock(&self.notes))
    }

    /// Checks for interrupts, and calls `progress` with the step, the parts that are done and all.
    fn poll(&self, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        Python::attach(|py| {
            py.check_signals()?;
            let Some(progress) = progress else { return Ok(()) };
            let (name, parts) = *lock(&self.step);
            progress.call1(py, (name, self.done.load(Ordering::Relaxed), parts)).map(drop)
        })
    }
}

/// The outcome of a computation without the interpreter lock. `progress`: a function that is called
/// with the step, the parts that are done and all parts. `n_threads`: all of the machine without
/// it.
///
/// # Errors
/// An interrupt, or an exception of `progress`, both of which stop the computation; no thread can
/// be started.
pub fn run<T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    n_threads: Option<usize>,
    work: impl FnOnce(&Arc<Call>) -> T + Send,
) -> PyResult<T> {
    let call = Arc::new(Call::default());
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, ended) = mpsc::channel::<()>();
            let compute = || {
                // Dropped at the end, also by a panic.
                let _sender = sender;
                in_pool(n_threads, || work(&call))
            };
            let worker = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, compute)?;
            let mut outcome = Ok(());
            while outcome.is_ok()
                && ended.recv_timeout(POLL) == Err(mpsc::RecvTimeoutError::Timeout)
            {
                outcome = call.poll(progress.as_ref());
            }
            // The last report, which is the first one of a short computation.
            if outcome.is_ok() && progress.is_some() {
                outcome = call.poll(progress.as_ref());
            }
            call.is_stopped.store(outcome.is_err(), Ordering::Relaxed);
            let result = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            outcome.map(|()| result)
        })
    })
}

static PROCESS: OnceLock<u32> = OnceLock::new();

/// Remembers the process in which the threads of the package are started.
pub fn remember_process() {
    PROCESS.get_or_init(process::id);
}

/// Threads other than those of rayon itself: their process and their number, 0 for all of the
/// machine.
type OwnThreads = ((u32, usize), Arc<ThreadPool>);

/// Does some work with threads that exist: a process that `fork` made has none of those before, so
/// it starts others, as does a call with a number of its own.
fn in_pool<T: Send>(n_threads: Option<usize>, work: impl FnOnce() -> T + Send) -> T {
    static LAST: Mutex<Option<OwnThreads>> = Mutex::new(None);
    let key = (process::id(), n_threads.unwrap_or(0));
    if PROCESS.get() == Some(&key.0) && n_threads.is_none() {
        return work();
    }
    let mut last = lock(&LAST);
    let pool = match &*last {
        Some((made_for, pool)) if *made_for == key => Some(pool.clone()),
        _ => {
            let pool = ThreadPoolBuilder::new().num_threads(key.1).stack_size(STACK);
            pool.build().ok().map(Arc::new)
        }
    };
    let Some(pool) = pool else { return work() };
    let before = last.replace((key, pool.clone()));
    // A pool of another process cannot be dropped: its threads are not there to end.
    std::mem::forget(before.filter(|((process, _), _)| *process != key.0));
    drop(last);
    pool.install(work)
}

fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}
