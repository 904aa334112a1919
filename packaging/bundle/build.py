"""Build a bundle that needs no Python: ``python3 packaging/bundle/build.py``.

Leaves ``build/bundle/Markermend`` (on macOS ``Markermend.app`` too) and, beside it, an archive to
hand out. Builds for the system it runs on; build on the oldest one that is to be supported.
"""

import os
import shutil
import subprocess
import sys
import tarfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import bootstrap

ROOT = bootstrap.ROOT
BUILD = ROOT / "build"
ENVIRONMENT, OUTPUT = BUILD / "bundle-venv", BUILD / "bundle"
PROGRAM = OUTPUT / "Markermend"
LARGEST_FOLDER_MB, LARGEST_ARCHIVE_MB = 300, 120
EXE = ".exe" if os.name == "nt" else ""


def main():
    """Build, try out, pack and measure; returns an exit code."""
    began = time.monotonic()
    python = make_environment()
    run(python, str(HERE / "licences.py"), str(BUILD / "bundle-licences" / "licences"))
    run(python, str(HERE / "icons.py"), str(BUILD / "bundle-icons"))
    run(
        *(python, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN"),
        *("--distpath", str(OUTPUT), "--workpath", str(BUILD / "bundle-work")),
        str(HERE / "markermend.spec"),
    )
    if os.name != "nt":
        (PROGRAM / "markermend-window").symlink_to("markermend")
    if sys.platform.startswith("linux"):
        strip_python()
        for name in ("markermend.desktop", "markermend-c3d.xml", "install.sh"):
            shutil.copy(str(HERE / "linux" / name), str(PROGRAM / name))
        shutil.copytree(str(BUILD / "bundle-icons"), str(PROGRAM / "icons"), dirs_exist_ok=True)
    try_out()
    archive = pack()
    sizes = (size_mb(PROGRAM), LARGEST_FOLDER_MB), (size_mb(archive), LARGEST_ARCHIVE_MB)
    bootstrap.say("Built in %.0f s:" % (time.monotonic() - began))
    for path, (size, limit) in zip((PROGRAM, archive), sizes):
        bootstrap.say("  %4.0f MB (at most %d)  %s" % (size, limit, path))
    return 1 if any(size > limit for size, limit in sizes) else 0


def make_environment():
    """Make an environment with the application and the builder alone; returns its Python."""
    folder = ENVIRONMENT / ("Scripts" if os.name == "nt" else "bin")
    python = str(folder / ("python" + EXE))
    if not os.path.exists(python):
        run(bootstrap.find_python(), "-m", "venv", str(ENVIRONMENT))
    # Not editable, since the metadata of an editable install names this folder.
    run(
        *(python, "-m", "pip", "install", "--quiet", "--prefer-binary"),
        *("--constraint", str(bootstrap.CONSTRAINTS)),
        *("--requirement", str(HERE / "requirements.txt"), "%s[app]" % ROOT),
    )
    return python


def strip_python():
    """Take the debugging symbols out of Python itself; NumPy's libraries do not survive it."""
    inside = PROGRAM / "_internal"
    found = [*inside.glob("libpython*.so*"), *inside.glob("python3*/lib-dynload/*.so")]
    if shutil.which("strip"):
        run("strip", "--strip-unneeded", *map(str, found))


def try_out():
    """Start what was built: the version, the main job, and a picture of the window."""
    demo = ROOT / "resources" / "markermend_resources" / "demo" / "demo.c3d"
    clean, picture = OUTPUT / "demo_clean.c3d", OUTPUT / "window.png"
    program = str(PROGRAM / ("markermend" + EXE))
    run(program, "--version")
    run(program, "clean", str(demo), "--output", str(clean), "--force")
    copy = shutil.copy(str(demo), str(OUTPUT))
    window = str(PROGRAM / ("markermend-window" + EXE))
    run(window, copy, "--screenshot", str(picture), QT_QPA_PLATFORM="offscreen")
    for path in OUTPUT.glob("demo*"):
        path.unlink()


def pack():
    """Pack the folder; returns the archive."""
    name = "Markermend-%s-%s" % (version(), sys.platform)
    if sys.platform.startswith("linux"):
        archive = OUTPUT / (name + ".tar.xz")
        with tarfile.open(str(archive), "w:xz", preset=6) as file:
            file.add(str(PROGRAM), "Markermend", filter=nobody)
        return archive
    what = "Markermend.app" if sys.platform == "darwin" else "Markermend"
    if sys.platform == "darwin":
        # Only ditto keeps what macOS needs of an application.
        archive = OUTPUT / (name + ".zip")
        run("ditto", "-c", "-k", "--keepParent", str(OUTPUT / what), str(archive))
        return archive
    return Path(shutil.make_archive(str(OUTPUT / name), "zip", str(OUTPUT), what))


def nobody(member):
    """Leave the builder's name and the time out, so that the same input gives the same archive."""
    member.uid = member.gid = 0
    member.uname = member.gname = ""
    member.mtime = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
    return member


def version():
    """Version of Markermend, from its one place."""
    text = (ROOT / "core" / "markermend" / "__init__.py").read_text(encoding="utf-8")
    return text.split('__version__ = "')[1].split('"')[0]


def size_mb(path):
    """Size of a file or folder."""
    files = [path] if path.is_file() else [p for p in path.rglob("*") if not p.is_symlink()]
    return sum(p.stat().st_size for p in files if p.is_file()) / 1e6


def run(*command, **variables):
    """Run a program, or stop with what it said."""
    env = bootstrap.child_environment(**variables)
    code = subprocess.call(command, env=env)
    if code != 0:
        raise bootstrap.SetupError("“%s” failed with exit code %d." % (" ".join(command), code))


if __name__ == "__main__":
    sys.exit(bootstrap.run_main(main))
