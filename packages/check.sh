#!/usr/bin/env bash
# Checks the packages in OUT: built again in another folder they are the same bytes; the Debian package
# draws in a new Debian and leaves nothing there when it is removed; every crate can be published, with
# its licences, and the package has the notices of every library within the programs.
# usage: packages/check.sh OUT, as root, with debootstrap
set -euo pipefail
out=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
step() { printf '== %s (%s s)\n' "$1" "$SECONDS"; }

step "every crate is packed and built from its package"
mapfile -t crates < <(grep -Lx 'publish = false' crates/*/Cargo.toml | cut -d / -f 2)
cargo package --quiet --target-dir "$out/build" "${crates[@]/#/--package=}"
for crate in "${crates[@]}"; do
    package=$(echo "$out/build/package/$crate"-[0-9]*.crate)
    inside=$(basename "$package" .crate)
    for text in LICENSE-MIT LICENSE-APACHE; do
        tar xzOf "$package" "$inside/$text" | cmp - "$text"
    done
    tar xzOf "$package" "$inside/README.md" | head -n 1 | grep -qx "# $crate"
done

# Libraries that were built for the programs, by the files that the compiler wrote.
step "notices of every crate that is linked in"
host=$(rustc -vV | sed -n 's/^host: //p')
own=$(cargo metadata --no-deps --format-version 1 | grep -o '"name":"ug[a-z]*"' | cut -d '"' -f 4)
notices=$(sed -n 's/^  \([a-zA-Z0-9_-]*\) [0-9].*/\1/p' "$out/tree/usr/share/doc/ugtools/copyright" | tr - _)
n=0
for library in "$out/build/$host"/release/deps/lib*.rlib; do
    name=$(basename "$library" | sed 's/^lib\(.*\)-[0-9a-f]*\.rlib$/\1/')
    grep -qx "$name" <<< "$own" && continue
    grep -qx "$name" <<< "$notices" || { echo "$name has no notice"; exit 1; }
    n=$((n + 1))
done
[ "$n" -gt 80 ]

step "another folder gives the same bytes"
git clone --quiet . "$place/elsewhere"
# The tasks have crates in common with those of this folder; the programs are built anew.
CARGO_TARGET_DIR=$PWD/target "$place/elsewhere/packages/build.sh" "$place/again" >/dev/null
diff "$out/SHA256SUMS" "$place/again/SHA256SUMS"

step "a new Debian"
debian=$place/debian
debootstrap --variant=minbase --include=man-db bookworm "$debian" >/dev/null
files() { (cd "$debian" && find . -path ./proc -prune -o -path './var/*' -prune -o -print | LC_ALL=C sort); }
files > "$place/before"
cp "$out"/ugtools_*.deb "$debian/tmp/ugtools.deb"
chroot "$debian" dpkg --install /tmp/ugtools.deb >/dev/null
commands='ugparse example --all
    uglorentz -vel .9 0 0 -in < ship.ug | ugdoppler | ugrainbow > ship.png
    ugphoton -cv 0 .5 0 -sz 160 120 street.ug > street.png
    ugfilm -frames 4 -ti 0..3 -sz 64 48 -fo ticks.gif ticks.ug'
chroot "$debian" sh -c "mkdir /tmp/drawn && cd /tmp/drawn && $commands"
chroot "$debian" man -w ugrainbow 5 unigrafix >/dev/null
chroot "$debian" sh -c 'zcat /usr/share/man/man1/ugrainbow.1.gz | grep -q NAME'
mkdir "$place/drawn"
(cd "$place/drawn" && export PATH="$out/tree/usr/bin:$PATH" && bash -c "$commands")
diff -r "$place/drawn" "$debian/tmp/drawn"
chroot "$debian" dpkg --purge ugtools >/dev/null
rm -r "$debian/tmp/drawn" "$debian/tmp/ugtools.deb"
files | diff "$place/before" -

step "done"
ls -l "$out"/ugtools*
