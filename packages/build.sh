#!/usr/bin/env bash
# Builds a Debian package and an archive of static programs, with man pages, completions, pages and
# example scenes, into the folder OUT. `cargo xtask package` runs it. A commit gives the same bytes in
# any folder.
# usage: packages/build.sh OUT
set -euo pipefail
out=$(mkdir -p "$1" && cd "$1" && pwd)
cd "$(dirname "$0")/.."

version=$(cargo pkgid -p uglorentz | sed 's/.*[#@]//')
host=$(rustc -vV | sed -n 's/^host: //p')
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH

# Static programs run on any distribution. Panics would name the folder of the crates.
RUSTFLAGS="-C target-feature=+crt-static --cfg disable_dispatch_sse4_2 --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}=cargo" \
    cargo build --quiet --release --target "$host" --target-dir "$out/build"

tree=$out/tree
rm -rf "$tree" "$out"/ugtools*
cargo xtask install --prefix "$tree/usr" --programs "$out/build/$host/release" >/dev/null
doc=$tree/usr/share/doc/ugtools
rm "$doc/installed.txt"
cargo xtask notices > "$doc/notices.txt"
cp -r scenes "$doc/examples"
find "$tree" -type d -exec chmod 755 {} + -o -type f -exec chmod 644 {} +
chmod 755 "$tree"/usr/bin/*

# name.tar.gz with the files of a folder under this name
archive() {
    tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
        --transform="s,^\.,$1," -C "$2" -cf - . | gzip -9n > "$out/$1.tar.gz"
}
archive "ugtools-$version-$(uname -m)-linux" "$tree/usr"

if command -v dpkg-deb >/dev/null; then
    gzip -9n "$tree"/usr/share/man/man*/*
    cat LICENSE LICENSE-MIT "$doc/notices.txt" > "$doc/copyright"
    rm "$doc/notices.txt"
    gzip -9nc CHANGELOG.md > "$doc/changelog.gz"
    mkdir "$tree/DEBIAN"
    size=$(find "$tree/usr" -type f -printf '%s\n' | awk '{ kib += int(($1 + 1023) / 1024) } END { print kib }')
    architecture=$(dpkg --print-architecture)
    sed "s/@VERSION@/$version/; s/@ARCHITECTURE@/$architecture/; s/@SIZE@/$size/" packages/control \
        > "$tree/DEBIAN/control"
    (cd "$tree" && find usr -type f | LC_ALL=C sort | xargs -d '\n' md5sum > DEBIAN/md5sums)
    dpkg-deb --root-owner-group -Zxz --build "$tree" "$out/ugtools_${version}_$architecture.deb" >/dev/null
fi
(cd "$out" && sha256sum ugtools* > SHA256SUMS && cat SHA256SUMS)
