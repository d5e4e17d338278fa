#!/usr/bin/env bash
# Builds the wheel of the Python package and tests it in a clean environment; `cargo xtask python` runs this.
#   check.sh PROGRAMS
# PROGRAMS: folder of the programs, with which files are compared.
set -euo pipefail
programs=$(realpath "$1")
cd "$(dirname "$0")"
target=$(realpath ../target)/python
wheels=$target/wheels
python=${PYTHON:-python3}

# The tools, which stay.
[ -x "$target/tools/bin/maturin" ] || "$python" -m venv "$target/tools"
"$target/tools/bin/pip" install --quiet --disable-pip-version-check 'maturin[zig]>=1.16,<2' auditwheel twine

rm -rf "$wheels"
begun=$SECONDS
# The command of README.md, word by word, but for the folder.
build=$(sed -n 's/^    \(maturin build .*\) --out .*/\1/p' README.md)
# Zig is found in the path alone.
(cd .. && PATH=$target/tools/bin:$PATH && $build --quiet --out "$wheels")
printf 'wheel: %s kB, built in %s s\n' "$(du -k "$wheels"/*.whl | cut -f 1)" $((SECONDS - begun))
"$target/tools/bin/twine" check --strict "$wheels"/*.whl
# It needs nothing of Linux that is newer than 2014.
"$target/tools/bin/auditwheel" show "$wheels"/*.whl | tee "$target/auditwheel"
tr '\n' ' ' < "$target/auditwheel" | grep -q 'platform tag: "manylinux_2_17_'

# The environment of the tests is new each time.
begun=$SECONDS
rm -rf "$target/clean"
"$python" -m venv "$target/clean"
"$target/clean/bin/pip" install --quiet --disable-pip-version-check -r tests/requirements.txt "$wheels"/*.whl
"$target/clean/bin/pip" check --disable-pip-version-check
printf 'environment: %s s\n' $((SECONDS - begun))

begun=$SECONDS
# Outside this folder, so that the installed package is tested and not these files.
(cd "$target" && UG_PROGRAMS=$programs "$target/clean/bin/python" -m pytest -q -p no:cacheprovider \
    -c "$OLDPWD/pyproject.toml" "$OLDPWD/tests")
printf 'tests: %s s\n' $((SECONDS - begun))
