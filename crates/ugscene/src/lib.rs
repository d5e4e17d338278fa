//! What the ug programs ask of a flat scene: bodies, rest geometry, vertex normals and colours
