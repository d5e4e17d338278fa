//! SVG figures on a sheet with themselves: no panic, the sheet is not much longer than the file, and
//! it is read again.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::Figure(ugimage::Format::Svg));
