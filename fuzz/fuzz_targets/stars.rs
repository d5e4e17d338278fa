//! Lists of stars: no panic, the light of every view is finite, and threads change nothing.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::Stars);
