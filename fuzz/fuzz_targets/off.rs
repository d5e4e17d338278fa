//! Meshes in this format: no panic, and what is made of them is read again.
#![no_main]

ug_fuzz::target!(ugtests::hostile::File::Mesh(ugmesh::MeshFormat::Off));
