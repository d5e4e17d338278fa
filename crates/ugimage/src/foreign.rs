//! Files that are none of those that are read, whatever their names say.

/// A kind of files that no program reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignKind {
    /// What such a file is, as in `a web page`.
    pub what: &'static str,
    /// What to do with it, as in `download the file itself`.
    pub remedy: &'static str,
    /// It holds pictures.
    pub is_picture: bool,
}

const WEB_PAGE: [&str; 2] = ["a web page", "download the file itself"];
const GIT_LFS: [&str; 2] = ["a Git LFS pointer", "fetch the file itself with `git lfs pull`"];
const UTF_16: [&str; 2] = ["UTF-16 text", "save it as UTF-8 or ASCII"];
const COMPRESSED: [&str; 2] = ["compressed data", "decompress it first"];
const CONVERT: &str = "convert it to PNG, JPEG, HDR, EXR or PFM";

/// Kinds by the bytes of files from a place on.
const KINDS: [(usize, &[u8], [&str; 2]); 17] = [
    (0, b"version https://git-lfs.github.com/spec/", GIT_LFS),
    (0, b"\xff\xfe", UTF_16),
    (0, b"\xfe\xff", UTF_16),
    (0, b"\x1f\x8b", COMPRESSED),
    (0, b"PK\x03\x04", COMPRESSED),
    (0, b"\xfd7zXZ", COMPRESSED),
    (0, b"\x28\xb5\x2f\xfd", COMPRESSED),
    (0, b"BZh", COMPRESSED),
    (0, b"7z\xbc\xaf", COMPRESSED),
    (0, b"GIF8", ["a GIF picture", CONVERT]),
    (0, b"II*\0", ["a TIFF picture", CONVERT]),
    (0, b"MM\0*", ["a TIFF picture", CONVERT]),
    (8, b"WEBP", ["a WebP picture", CONVERT]),
    (4, b"ftyp", ["a HEIC or AVIF picture", CONVERT]),
    (4, b"JXL ", ["a JPEG XL picture", CONVERT]),
    (0, b"8BPS", ["a Photoshop picture", CONVERT]),
    (0, b"%PDF", ["a PDF document", CONVERT]),
];

/// What a file is by its first bytes; `None` if it may be one that is read.
pub fn foreign_kind(file: &[u8]) -> Option<ForeignKind> {
    let start = file.trim_ascii_start();
    let begins = |word: &&[u8]| start.get(..word.len()).is_some_and(|it| it.eq_ignore_ascii_case(word));
    let page = [&b"<!doctype html"[..], b"<html"].iter().any(begins).then_some(WEB_PAGE);
    let is_kind =
        |(at, bytes, _): &&(usize, &[u8], _)| file.get(*at..).is_some_and(|it| it.starts_with(bytes));
    let [what, remedy] = page.or_else(|| KINDS.iter().find(is_kind).map(|(.., words)| *words))?;
    Some(ForeignKind { what, remedy, is_picture: remedy == CONVERT })
}
