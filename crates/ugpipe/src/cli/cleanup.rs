//! Nothing is left behind when a signal ends the program: temporary files are deleted and
//! programs that an input named are stopped. What SIGKILL leaves, the next run deletes.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::sync::atomic::AtomicBool;
use std::sync::mpsc;
use std::sync::{Arc, Mutex, MutexGuard, Once, PoisonError};
use std::thread;

use rustix::process::{Pid, Signal, kill_process_group};
use signal_hook::consts::{
    SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGSYS, SIGTERM, SIGTRAP, SIGUSR1, SIGUSR2,
    SIGVTALRM, SIGXCPU, SIGXFSZ,
};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use signal_hook::low_level::{emulate_default_handler, exit};
use tempfile::NamedTempFile;

use crate::cli::folder::folder_of;
use crate::cli::stale::{self, lock};

/// Signals that end a program and do not come from a fault in it. SIGKILL cannot be handled;
/// SIGABRT ends a program without memory, see [`crate::main`].
const SIGNALS: [i32; 12] = [
    SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGSYS, SIGTERM, SIGTRAP, SIGUSR1, SIGUSR2,
    SIGVTALRM, SIGXCPU,
];

/// More of them on Linux: SIGSTKFLT, SIGIO, SIGPWR and the real-time signals.
const OF_LINUX: [std::ops::RangeInclusive<i32>; 3] = [16..=16, 29..=30, 34..=64];

/// The files to remove. A signal is handled with this locked, so that nothing is created meanwhile.
static LEFTOVERS: Mutex<Leftovers> =
    Mutex::new(Leftovers { files: BTreeSet::new(), groups: Vec::new() });

struct Leftovers {
    files: BTreeSet<PathBuf>,
    groups: Vec<Pid>,
}

fn leftovers() -> MutexGuard<'static, Leftovers> {
    LEFTOVERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What temporary files of outputs begin with.
pub(crate) const PREFIX: &str = ".ug-";

/// Characters that `tempfile` adds to [`PREFIX`].
const N_RANDOM: usize = 6;

/// A temporary file that a signal deletes. It is locked as long as its process runs, so that other
/// processes can tell it from what was left.
pub(crate) struct Temporary(NamedTempFile);

impl Temporary {
    /// Creates one with `create`, in the folder of `target`. Before the first one in a folder,
    /// those that killed processes left there are deleted.
    pub(crate) fn new(
        target: &Path,
        create: impl Fn() -> io::Result<NamedTempFile>,
    ) -> io::Result<Self> {
        static CLEANED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
        handle_signals();
        let folder = folder_of(target);
        if CLEANED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
            stale::remove(folder, is_temporary);
        }
        let mut leftovers = leftovers();
        loop {
            let file = create()?;
            // Another process may have deleted it before it was locked.
            if lock(file.as_file()) {
                leftovers.files.insert(file.path().to_owned());
                return Ok(Self(file));
            }
        }
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

/// True for names of temporary files: `.ug-a1b2C3.png`.
fn is_temporary(name: &str) -> bool {
    let Some((random, ending)) =
        name.strip_prefix(PREFIX).and_then(|rest| rest.split_at_checked(N_RANDOM))
    else {
        return false;
    };
    random.bytes().all(|byte| byte.is_ascii_alphanumeric())
        && (ending.is_empty() || ending.starts_with('.'))
}

/// A file that marks what one process works on. It is deleted when this is dropped, or by a signal.
pub struct Claim {
    /// The file; `None` if something else is in its place.
    path: Option<PathBuf>,
    /// Locked as long as it is open.
    _file: Option<fs::File>,
}

/// True if a link, a folder, a pipe or a device has this name: helper files are neither written to
/// nor read from these.
pub fn is_occupied(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| !found.is_file())
}

impl Claim {
    /// Creates and locks the file; `None` if another process has locked it. Where files cannot be
    /// created or locked, every process has the claim.
    pub fn new(path: &Path) -> Option<Self> {
        if is_occupied(path) {
            return Some(Self { path: None, _file: None });
        }
        handle_signals();
        let mut leftovers = leftovers();
        let opened = fs::OpenOptions::new().write(true).create(true).truncate(false).open(path);
        let file = match opened {
            Ok(file) if matches!(file.try_lock(), Err(fs::TryLockError::WouldBlock)) => {
                return None;
            }
            Ok(file) => Some(file),
            Err(_) => None,
        };
        leftovers.files.insert(path.to_owned());
        Some(Self { path: Some(path.to_owned()), _file: file })
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            let mut leftovers = leftovers();
            // It fails if another process has removed the file, which is harmless.
            let _ = fs::remove_file(path);
            leftovers.files.remove(path);
        }
    }
}

/// A running program in a process group of its own, which a signal stops.
pub struct Running {
    child: Child,
    group: Pid,
}

impl Running {
    /// Starts a program.
    ///
    /// # Errors
    /// Those of [`Command::spawn`].
    pub fn spawn(command: &mut Command) -> io::Result<Self> {
        use std::os::unix::process::CommandExt;
        handle_signals();
        let mut leftovers = leftovers();
        let child = command.process_group(0).spawn()?;
        let group = Pid::from_child(&child);
        leftovers.groups.push(group);
        Ok(Self { child, group })
    }

    /// The program.
    pub fn child_mut(&mut self) -> &mut Child {
        &mut self.child
    }

    /// Ends the program and those it has started.
    pub fn stop(&self) {
        // It may have ended by itself.
        let _ = kill_process_group(self.group, Signal::KILL);
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        leftovers().groups.retain(|&group| group != self.group);
    }
}

/// The thread that waits for signals is started, or never will be.
static STARTED: Once = Once::new();

/// Leaves all signals to the process, of which programs are functions. Call it before them: their
/// temporary files are then removed when they return, but not when a signal ends the process.
pub fn leave_signals() {
    STARTED.call_once(|| ());
}

/// Starts the thread that waits for signals, once. Signals that are ignored (`nohup`) stay ignored.
fn handle_signals() {
    STARTED.call_once(|| {
        let (sender, receiver) = mpsc::channel();
        let work = move || {
            let ignored = ignored_signals();
            let of_linux = OF_LINUX.into_iter().flatten().filter(|_| cfg!(target_os = "linux"));
            let signals = SIGNALS.into_iter().chain(of_linux);
            let signals = Signals::new(signals.filter(|signal| ignored >> (signal - 1) & 1 == 0));
            let _ = sender.send(());
            if let Some(signal) = signals.ok().and_then(|mut signals| signals.forever().next()) {
                end(signal);
            }
        };
        // Signals are handled only where there is a thread: otherwise they would be lost. Without
        // it a signal ends the program as before, and may leave a file.
        if thread::Builder::new().name("signals".to_owned()).spawn(work).is_ok() {
            let _ = receiver.recv();
        }
    });
}

/// Makes writing beyond the limit of the size of files (`ulimit -f`) an error, instead of a signal
/// that ends the program.
pub(crate) fn survive_size_limits() {
    // Without the handler the signal ends the program as before.
    let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
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
    // Its default action is not known here.
    exit(128 + signal);
}

/// Bit n − 1 is set if signal n is ignored; zero on systems other than Linux, which do not say.
fn ignored_signals() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temporary_files_are_known_by_their_names() {
        for name in [".ug-a1b2C3", ".ug-abcdef.png", ".ug-000000.tar.gz"] {
            assert!(is_temporary(name), "{name}");
        }
        for name in
            ["ug-a1b2C3", ".ug-a1b2C", ".ug-a1b2C3x", ".ug-a1b2-3.png", ".ug-é12345", ".ug-"]
        {
            assert!(!is_temporary(name), "{name}");
        }
    }

    #[test]
    fn a_claim_is_held_by_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("claim");
        let claim = Claim::new(&path).unwrap();
        assert!(Claim::new(&path).is_none());
        drop(claim);
        assert!(Claim::new(&path).is_some());
        // Where nothing can be created, all have it.
        let nowhere = folder.path().join("no/claim");
        let claims = [Claim::new(&nowhere), Claim::new(&nowhere)];
        assert!(claims.iter().all(Option::is_some));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
