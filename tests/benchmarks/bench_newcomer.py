"""A newcomer's three ways to a first cleaned take, timed from nothing.

::

    python tests/benchmarks/bench_newcomer.py [--bundle ARCHIVE]

From ``git clone`` by the README's command; from ``pip install`` into an empty environment; from
unpacking a bundle (where an archive of ``packaging/bundle/build.py`` is named). Each ends when the
demo take is cleaned; files and packages come from this machine's network and caches.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tarfile
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DEMO = ROOT / "resources" / "markermend_resources" / "demo" / "demo.c3d"


def main(arguments: Sequence[str] | None = None) -> int:
    """Go each way once."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bundle", type=Path)
    chosen = parser.parse_args(arguments)
    timed("git clone, packaging/run.py", from_clone)
    timed("pip install, markermend clean", from_pip)
    if chosen.bundle is not None:
        timed(
            "unpack the bundle, markermend clean", lambda folder: from_bundle(folder, chosen.bundle)
        )
    return 0


def timed(way: str, go: Callable[[Path], Path]) -> None:
    """Print how long a way takes, and see that its end is there."""
    with tempfile.TemporaryDirectory() as folder:
        began = time.monotonic()
        clean = go(Path(folder))
        seconds = time.monotonic() - began
        assert clean.stat().st_size == DEMO.stat().st_size, f"{way} cleaned nothing"
    print(f"{way:<40} {seconds:6.1f} s", flush=True)  # noqa: T201


def from_clone(folder: Path) -> Path:
    """The README's first command on a machine without a display."""
    run("git", "clone", "--quiet", str(ROOT), str(folder / "markermend"))
    run(sys.executable, "packaging/run.py", cwd=folder / "markermend")
    return folder / "markermend" / "build" / "review" / "demo_clean.c3d"


def from_pip(folder: Path) -> Path:
    """What a pipeline engineer does."""
    run(sys.executable, "-m", "venv", str(folder / "venv"))
    python = folder / "venv" / ("Scripts" if os.name == "nt" else "bin") / "python"
    run(str(python), "-m", "pip", "install", "--quiet", str(ROOT))
    run(str(python), "-m", "markermend", "clean", str(DEMO), "-o", str(folder / "clean.c3d"))
    return folder / "clean.c3d"


def from_bundle(folder: Path, archive: Path) -> Path:
    """What an operator without Python does."""
    with tarfile.open(archive) as file:
        file.extractall(folder, filter="data")
    program = folder / "Markermend" / "markermend"
    run(str(program), "clean", str(DEMO), "-o", str(folder / "clean.c3d"))
    return folder / "clean.c3d"


def run(*command: str, cwd: Path | None = None) -> None:
    """Run a program as on a machine of its own: no display, no paths of this one."""
    env = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "PYTHONPATH")}
    subprocess.run(command, check=True, cwd=cwd, env=env, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    sys.exit(main())
