//! Streams and signals that a shell, a full disk or an impatient person gives a program.

use ugtesting::Random;

/// How the streams of the last stage are connected, and what interrupts it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// As usual.
    Plain,
    /// Standard output loses what is written, as this redirection says.
    Output(&'static str),
    /// Nobody reads standard output.
    Unread,
    /// Standard input cannot be read.
    Input(&'static str),
    /// Messages are lost.
    Messages(&'static str),
    /// The output file cannot be written.
    File(&'static str),
    /// A limit of the shell: address space in KiB, blocks of a file, processes.
    Limit(&'static str),
    /// A signal comes after this many milliseconds, while a file is written.
    Signal {
        /// Its name, without SIG.
        name: &'static str,
        /// Its number.
        number: i32,
        /// When it comes.
        after_ms: u64,
    },
}

/// Signals that end a program, without SIG, and their numbers on Linux.
const SIGNALS: [(&str, i32); 7] =
    [("INT", 2), ("TERM", 15), ("HUP", 1), ("QUIT", 3), ("ALRM", 14), ("XCPU", 24), ("USR1", 10)];

fn word(random: &mut Random, some: &[&'static str]) -> &'static str {
    some[random.below(some.len())]
}

/// The output file of a stage that a signal or a limit interrupts.
pub const INTERRUPTED: &str = "interrupted.out";

/// Closed standard input: Rust opens `/dev/null` in its place, so it is read as an empty scene.
pub const CLOSED: &str = "0<&-";

impl Edge {
    /// Mostly as usual.
    pub fn new(random: &mut Random) -> Self {
        match random.below(40) {
            0 | 1 => Self::Output(word(random, &["1>/dev/full", "1</dev/null"])),
            2 => Self::Unread,
            3 => Self::Input(word(random, &[CLOSED, "0<.", "0>/dev/null"])),
            4 => Self::Messages(word(random, &["2>&-", "2>/dev/full", "2</dev/null"])),
            5 => Self::File(word(random, &["/dev/full", ".", "missing/out", "scene.ug/out", ""])),
            6 | 7 => {
                let (name, number) = *random.pick(&SIGNALS);
                Self::Signal { name, number, after_ms: random.below(12) as u64 }
            }
            8 | 9 => Self::Limit(word(
                random,
                &[
                    "ulimit -v 60000;",
                    "ulimit -v 120000;",
                    "ulimit -v 300000;",
                    "ulimit -v 700000;",
                    "ulimit -f 0;",
                    "ulimit -f 1;",
                    "ulimit -f 3;",
                    "ulimit -u 2;",
                ],
            )),
            _ => Self::Plain,
        }
    }

    /// The command of the shell that sets a limit.
    pub fn limit(self) -> &'static str {
        if let Self::Limit(words) = self { words } else { "" }
    }

    /// True if there is little address space.
    pub fn limits_memory(self) -> bool {
        self.limit().contains("-v")
    }

    /// The redirection in words of a shell.
    pub fn redirection(self) -> &'static str {
        match self {
            Self::Output(words) | Self::Input(words) | Self::Messages(words) => words,
            Self::Plain | Self::Unread | Self::File(_) | Self::Limit(_) | Self::Signal { .. } => "",
        }
    }

    /// More arguments of the program.
    pub fn arguments(self) -> Vec<String> {
        match self {
            Self::File(path) => vec!["-fo".to_owned(), path.to_owned()],
            Self::Limit(_) | Self::Signal { .. } => vec!["-fo".to_owned(), INTERRUPTED.to_owned()],
            _ => Vec::new(),
        }
    }

    /// True if a successful stage has written to the standard output that is looked at.
    pub fn keeps_output(self) -> bool {
        matches!(self, Self::Plain | Self::Input(_) | Self::Messages(_))
    }

    /// True if messages are kept.
    pub fn keeps_messages(self) -> bool {
        !matches!(self, Self::Messages(_)) && !self.limit().contains("-f")
    }
}
