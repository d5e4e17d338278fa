//! Special relativity and colour physics as pure functions
