#!/usr/bin/env bash
# Builds the wheel of the Python package and tests it in a clean environment; `cargo xtask python` runs this.
#   check.sh PROGRAMS [--manylinux]
# PROGRAMS: folder of the programs, with which files are compared. --manylinux: also builds the wheel for
# glibc 2.17, with the linker of Zig.
set -euo pipefail
programs=$(realpath "$1")
cd "$(dirname "$0")"
target=$(realpath ../target)/python
wheels=$target/wheels
python=${PYTHON:-python3}

# The tools, which stay.
[ -x "$target/tools/bin/maturin" ] || "$python" -m venv "$target/tools"
"$target/tools/bin/pip" install --quiet --disable-pip-version-check 'maturin>=1.16,<2'

rm -rf "$wheels"
begun=$SECONDS
"$target/tools/bin/maturin" build --release --quiet --manifest-path Cargo.toml --out "$wheels"
printf 'wheel: %s kB, built in %s s\n' "$(du -k "$wheels"/*.whl | cut -f 1)" $((SECONDS - begun))

# The environment of the tests is new each time.
begun=$SECONDS
rm -rf "$target/clean"
"$python" -m venv "$target/clean"
"$target/clean/bin/pip" install --quiet --disable-pip-version-check -r tests/requirements.txt "$wheels"/*.whl
printf 'environment: %s s\n' $((SECONDS - begun))

begun=$SECONDS
# Outside this folder, so that the installed package is tested and not these files.
(cd "$target" && UG_PROGRAMS=$programs "$target/clean/bin/python" -m pytest -q -p no:cacheprovider \
    -c "$OLDPWD/pyproject.toml" "$OLDPWD/tests")
printf 'tests: %s s\n' $((SECONDS - begun))

if [ "${2:-}" = --manylinux ]; then
    "$target/tools/bin/pip" install --quiet --disable-pip-version-check ziglang
    # Zig is found in the path alone.
    PATH=$target/tools/bin:$PATH maturin build --release --quiet --manifest-path Cargo.toml --zig \
        --compatibility manylinux2014 --out "$target/manylinux"
    ls -l "$target/manylinux"
fi
