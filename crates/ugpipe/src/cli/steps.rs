//! Progress shown to the user: the time of each step with `-vb`, and a progress bar for long runs.

use std::io::{self, IsTerminal};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cli::messages::Messages;
use crate::progress::Progress;

/// The progress bar appears after this time.
const BAR_DELAY: Duration = Duration::from_secs(1);

/// Shows progress to the user of a program, see [`crate::Context::steps`].
pub struct Steps<'m> {
    messages: &'m Messages,
    shows_bar: bool,
    current: Mutex<Option<Step>>,
}

struct Step {
    name: &'static str,
    begun: Duration,
    /// Hidden until the program has run for [`BAR_DELAY`].
    bar: Option<ProgressBar>,
}

impl<'m> Steps<'m> {
    pub(crate) fn new(messages: &'m Messages) -> Self {
        let shows_bar =
            !messages.is_quiet() && messages.host().is_none() && io::stderr().is_terminal();
        Self { messages, shows_bar, current: Mutex::new(None) }
    }

    /// Begins a step whose parts count for the user, such as frames: the bar shows how many are
    /// done, how many a second, and the time left.
    pub fn count(&self, name: &'static str, parts: u64) {
        self.switch_to(Some((
            name,
            parts,
            "{prefix}: {msg} [{bar:40}] {pos} of {len}, {per_sec}, {eta} left",
        )));
    }

    fn bar(&self, name: &'static str, parts: u64, template: &str) -> ProgressBar {
        let bar = ProgressBar::with_draw_target(Some(parts), ProgressDrawTarget::hidden());
        // The template is valid; otherwise the bar would keep its default style.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.with_prefix(self.messages.program().to_owned()).with_message(name)
    }

    /// Ends the current step and begins the next, if there is one.
    fn switch_to(&self, next: Option<(&'static str, u64, &str)>) {
        let mut current = self.lock();
        if let Some(Step { name, begun, bar }) = current.take() {
            bar.iter().for_each(ProgressBar::finish_and_clear);
            let seconds = (self.messages.elapsed() - begun).as_secs_f64();
            self.messages.detail(&format!("{name} took {seconds:.3} s"));
        }
        *current = next.map(|(name, parts, template)| {
            self.messages.host().iter().for_each(|host| host.step(name, parts));
            let bar = (self.shows_bar && parts > 0).then(|| self.bar(name, parts, template));
            Step { name, begun: self.messages.elapsed(), bar }
        });
    }

    fn lock(&self) -> MutexGuard<'_, Option<Step>> {
        // A poisoned lock is usable: a panic cannot leave the state inconsistent.
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Progress for Steps<'_> {
    fn step(&self, name: &'static str, parts: u64) {
        self.switch_to(Some((name, parts, "{prefix}: {msg} [{bar:40}] {percent}%")));
    }

    fn done(&self, parts: u64) {
        self.messages.host().iter().for_each(|host| host.done(parts));
        if let Some(Step { bar: Some(bar), .. }) = &*self.lock() {
            if bar.is_hidden() && self.messages.elapsed() >= BAR_DELAY {
                bar.set_draw_target(ProgressDrawTarget::stderr());
            }
            bar.inc(parts);
        }
    }

    fn is_stopped(&self) -> bool {
        self.messages.host().is_some_and(|host| host.is_stopped())
    }
}

impl Drop for Steps<'_> {
    fn drop(&mut self) {
        self.switch_to(None);
    }
}
