//! One selection of features for the dependencies of all crates. There is no code here.
//!
//! Cargo builds a dependency with the features that the selected packages and their tests
//! ask for. So `--workspace`, the default members, `-p` of one program, and tests would each
//! want a few small crates such as `num-traits` or `libc` with other features, and everything
//! that stands on them would be built again. ugpipe depends on this package, and every program
//! on ugpipe, so that the features listed in its `Cargo.toml` are always on.
