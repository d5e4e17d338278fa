//! Pictures of every format with a history: no panic, and it is written as it is read.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::History);
