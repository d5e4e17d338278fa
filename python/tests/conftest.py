"""What the tests share: the scenes of the repository, and the programs with which files are compared."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAMS = Path(os.environ.get("UG_PROGRAMS", ROOT / "target" / "release"))


@pytest.fixture
def shell(monkeypatch: pytest.MonkeyPatch):
    """Runs a pipe of programs in the root of the repository, where names of files are the same."""
    monkeypatch.chdir(ROOT)

    def run(line: str, **options) -> bytes:
        path = f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}"
        ran = subprocess.run(
            ["bash", "-o", "pipefail", "-c", line],
            capture_output=True, env={**os.environ, "PATH": path}, check=False, **options,
        )
        assert ran.returncode == 0, ran.stderr.decode()
        return ran.stdout

    return run
