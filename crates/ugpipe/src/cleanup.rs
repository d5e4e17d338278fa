//! Nothing is left behind when a signal ends the program: temporary files are deleted and
//! programs that an input named are stopped.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::thread;

use rustix::process::{Pid, Signal, kill_process_group};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use tempfile::NamedTempFile;

/// What to remove. A signal is handled with this locked, so that nothing is created meanwhile.
static LEFTOVERS: Mutex<Leftovers> = Mutex::new(Leftovers { files: BTreeSet::new(), groups: Vec::new() });

struct Leftovers {
    files: BTreeSet<PathBuf>,
    groups: Vec<Pid>,
}

fn leftovers() -> MutexGuard<'static, Leftovers> {
    LEFTOVERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file that a signal deletes.
pub(crate) struct Temporary(NamedTempFile);

impl Temporary {
    /// Creates one with `create`.
    pub(crate) fn new(create: impl FnOnce() -> io::Result<NamedTempFile>) -> io::Result<Self> {
        handle_signals();
        let mut leftovers = leftovers();
        let file = create()?;
        leftovers.files.insert(file.path().to_owned());
        Ok(Self(file))
    }

    pub(crate) fn file_mut(&mut self) -> &mut fs::File {
        self.0.as_file_mut()
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Renames the file to `target`.
    pub(crate) fn persist(self, target: &Path) -> io::Result<()> {
        let mut leftovers = leftovers();
        let path = self.0.path().to_owned();
        let outcome = self.0.persist(target);
        leftovers.files.remove(&path);
        outcome.map(drop).map_err(|error| error.error)
    }
}

/// A running program in a process group of its own, which a signal stops.
pub(crate) struct Running {
    child: Child,
    group: Pid,
}

impl Running {
    pub(crate) fn spawn(command: &mut Command) -> io::Result<Self> {
        use std::os::unix::process::CommandExt;
        handle_signals();
        let mut leftovers = leftovers();
        let child = command.process_group(0).spawn()?;
        let group = Pid::from_child(&child);
        leftovers.groups.push(group);
        Ok(Self { child, group })
    }

    pub(crate) fn child_mut(&mut self) -> &mut Child {
        &mut self.child
    }

    /// Ends the program and those it has started.
    pub(crate) fn stop(&self) {
        // It may have ended by itself.
        let _ = kill_process_group(self.group, Signal::KILL);
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        leftovers().groups.retain(|&group| group != self.group);
    }
}

/// Starts the thread that waits for signals, once. Signals that are ignored (`nohup`) stay ignored.
fn handle_signals() {
    static STARTED: Once = Once::new();
    STARTED.call_once(|| {
        let ignored = ignored_signals();
        let signals = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
        // Without the thread a signal ends the program as before, and may leave a file.
        if let Ok(mut signals) = Signals::new(signals) {
            let _ = thread::Builder::new().name("signals".to_owned()).spawn(move || {
                if let Some(signal) = signals.forever().next() {
                    end(signal);
                }
            });
        }
    });
}

/// Removes everything and ends the program as the signal would have.
fn end(signal: i32) {
    let leftovers = leftovers();
    for &group in &leftovers.groups {
        let _ = kill_process_group(group, Signal::KILL);
    }
    for file in &leftovers.files {
        let _ = fs::remove_file(file);
    }
    let _ = emulate_default_handler(signal);
}

/// Bit n − 1 is set if signal n is ignored; zero on systems other than Linux, which do not say.
fn ignored_signals() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
