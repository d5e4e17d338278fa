//! The standard streams that were closed when the program was started.
//!
//! Before `main`, the runtime of Rust opens `/dev/null` in place of closed streams, so that no
//! other file gets their numbers. From then on a closed output cannot be told from one that nobody
//! wants. So they are examined earlier, where C programs run their constructors.

use std::io;
use std::os::fd::AsFd;
use std::sync::atomic::{AtomicBool, Ordering};

static STDIN_IS_CLOSED: AtomicBool = AtomicBool::new(false);
static STDOUT_IS_CLOSED: AtomicBool = AtomicBool::new(false);

// The macro requires the word `unsafe`, since the function runs before the runtime has begun: it
// must not start threads or panic. It only reads flags of descriptors.
ctor_lite::ctor! {
    unsafe fn examine() {
        STDIN_IS_CLOSED.store(is_closed(&io::stdin()), Ordering::Relaxed);
        STDOUT_IS_CLOSED.store(is_closed(&io::stdout()), Ordering::Relaxed);
    }
}

fn is_closed(stream: &impl AsFd) -> bool {
    rustix::io::fcntl_getfd(stream) == Err(rustix::io::Errno::BADF)
}

/// # Errors
/// Standard input was closed.
pub(crate) fn require_stdin() -> io::Result<()> {
    open(&STDIN_IS_CLOSED)
}

/// # Errors
/// Standard output was closed.
pub(crate) fn require_stdout() -> io::Result<()> {
    open(&STDOUT_IS_CLOSED)
}

fn open(is_closed: &AtomicBool) -> io::Result<()> {
    match is_closed.load(Ordering::Relaxed) {
        true => Err(io::Error::other("it was closed when the program was started")),
        false => Ok(()),
    }
}
