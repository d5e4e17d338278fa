//! PNG files with a history: no panic, and a sheet of them is read as it was written.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::Picture);
