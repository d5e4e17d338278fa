//! Damage to the bytes of a file.

use ugtesting::Random;

/// Changes some bytes, cuts, repeats or inserts some.
pub fn damage(random: &mut Random, bytes: &mut Vec<u8>) {
    const WORDS: [&[u8]; 10] = [
        b"\0",
        b"\r",
        b"\xef\xbb\xbf",
        b"\x1b[31m",
        b"{",
        b"}",
        b"(",
        b";",
        b"1e309",
        b"\xe2\x80\xae",
    ];
    for _ in 0..1 + random.below(4) {
        if bytes.is_empty() {
            return;
        }
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(60)).min(bytes.len());
        match random.below(7) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.below(256) as u8,
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let part = bytes[at..end].repeat(1 + random.below(200));
                drop(bytes.splice(at..at, part));
            }
            5 => drop(bytes.splice(at..at, random.pick(&WORDS).iter().copied())),
            _ => drop(bytes.splice(at..at, vec![b' '; random.below(20_000)])),
        }
    }
}
