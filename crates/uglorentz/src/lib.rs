//! Geometry of a UniGrafix scene as seen in relativistic motion
