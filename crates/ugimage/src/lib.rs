//! Frame buffer and picture formats
