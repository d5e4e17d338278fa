//! PNG, JPEG, HDR and EXR files as panoramas: no panic, the light of every view is finite, and
//! threads change nothing.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::Panorama);
