//! Scanline renderer for relativistic UniGrafix scenes
