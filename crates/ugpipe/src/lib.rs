//! The Unix edge of the ug programs: arguments, streams, messages, exit codes
