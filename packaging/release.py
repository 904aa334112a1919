"""Build what a release consists of, and try it out: ``python3 packaging/release.py``.

Leaves a wheel and a source archive in ``dist``. Both are built twice, to see that the same source
gives the same bytes; checked as the package index does; and the wheel is installed into an empty
environment, where it has to do the main job.
"""

import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import bootstrap

ROOT = bootstrap.ROOT
TOOLS = ("build>=1.2", "twine>=6")


def main():
    """Build, compare, check, install; returns an exit code."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        tools = make_environment(work / "tools", *TOOLS)
        first, second = (build(tools, work / name) for name in ("first", "second"))
        if first != second:
            raise bootstrap.SetupError("Building twice gave different files: %s" % first)
        files = [str(work / "first" / name) for name in sorted(first)]
        run(tools, "-m", "twine", "check", "--strict", *files)
        wheel = next(f for f in files if f.endswith(".whl"))
        try_out(make_environment(work / "empty", wheel), work)
        shutil.rmtree(str(ROOT / "dist"), ignore_errors=True)
        shutil.copytree(str(work / "first"), str(ROOT / "dist"))
    for name, digest in sorted(first.items()):
        size = (ROOT / "dist" / name).stat().st_size / 1e6
        bootstrap.say("  %5.1f MB  %s  sha256 %s" % (size, name, digest))
    return 0


def build(python, target):
    """Build into a folder; returns the hash of each file by name."""
    run(python, "-m", "build", "--quiet", "--outdir", str(target), str(ROOT))
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in target.iterdir()}


def try_out(python, work):
    """Clean a simulated take with what was installed, far from the source."""
    take, clean = str(work / "take.c3d"), str(work / "clean.c3d")
    command = [python, "-m", "markermend"]
    run(*command, "simulate", "--duration", "5", "--output", take, cwd=str(work))
    run(*command, "clean", take, "--output", clean, cwd=str(work))


def make_environment(folder, *packages):
    """Make an environment with some packages; returns its Python."""
    run(bootstrap.find_python(), "-m", "venv", str(folder))
    python = str(folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python"))
    run(python, "-m", "pip", "install", "--quiet", "--prefer-binary", *packages)
    return python


def run(*command, **options):
    """Run a program, or stop with what it said."""
    code = subprocess.call(command, env=bootstrap.child_environment(), **options)
    if code != 0:
        raise bootstrap.SetupError("“%s” failed with exit code %d." % (" ".join(command), code))


if __name__ == "__main__":
    sys.exit(bootstrap.run_main(main))
