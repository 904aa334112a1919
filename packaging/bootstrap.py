"""Set Markermend up with nothing but Python and git: what run.py and test.py share.

Standard library only, and written so that Python 3.8 can parse and run it: an older interpreter
shall find a newer one, or get a sentence instead of a syntax error.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
CONSTRAINTS = ROOT / "packaging" / "constraints.txt"
OLDEST = (3, 11)
CANDIDATES = ("3.12", "3.13", "3.14", "3.11")

# Library that Qt loads, and the Debian or Ubuntu package that brings it.
OFFSCREEN_LIBRARIES = {
    "libglib-2.0.so.0": "libglib2.0-0",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
}
X11_LIBRARIES = {
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-image.so.0": "libxcb-image0",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-randr.so.0": "libxcb-randr0",
    "libxcb-render-util.so.0": "libxcb-render-util0",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxcb-sync.so.1": "libxcb-sync1",
    "libxcb-xfixes.so.0": "libxcb-xfixes0",
    "libxcb-xkb.so.1": "libxcb-xkb1",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
    "libX11-xcb.so.1": "libx11-xcb1",
}
WAYLAND_LIBRARIES = {
    "libwayland-client.so.0": "libwayland-client0",
    "libwayland-cursor.so.0": "libwayland-cursor0",
    "libwayland-egl.so.1": "libwayland-egl1",
}

_TRY_LIBRARIES = """
import ctypes, sys
for name in sys.argv[1:]:
    try:
        ctypes.CDLL(name)
    except OSError:
        print(name)
"""
_TRY_DISPLAY = """
import sys
from PySide6.QtGui import QGuiApplication
app = QGuiApplication([])
sys.exit(0 if app.primaryScreen() else 1)
"""


class SetupError(Exception):
    """Something the person at the keyboard has to put right; its text is one clear message."""


def say(text):
    """Tell where we are; flushed, so that it stands before what a child process prints."""
    print(text, flush=True)


def child_environment(**extra):
    """Environment for child processes: ours, without what would lead pip or Python astray."""
    env = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONHOME")}
    env.update(PIP_USER="0", PIP_DISABLE_PIP_VERSION_CHECK="1", PIP_NO_INPUT="1")
    # More than one OpenBLAS thread is far slower than one on small matrices under a CPU quota.
    env.setdefault("OPENBLAS_NUM_THREADS", "1")
    env.update(extra)
    return env


def ask(command, timeout=60):
    """Return what a command prints, or None when it cannot be run or fails."""
    try:
        done = subprocess.run(
            command,
            env=child_environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            universal_newlines=True,
            timeout=timeout,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def find_python():
    """Return the path of a Python 3.11 or newer: this one, or one found on the machine."""
    if sys.version_info[:2] >= OLDEST:
        # Started by .venv's own Python, which may have to be made anew: take the one beneath it.
        inside = Path(sys.prefix).resolve() == VENV.resolve()
        return getattr(sys, "_base_executable", sys.executable) if inside else sys.executable
    for version in CANDIDATES:
        launch = ["py", "-" + version] if os.name == "nt" else ["python" + version]
        path = shutil.which(launch[0])
        # A name on the path proves nothing: version managers leave shims for absent versions.
        found = path and ask([path, *launch[1:], "-c", "import sys; print(sys.executable)"])
        if found:
            return found
    raise SetupError(
        "Markermend needs Python 3.11 or newer. This is Python %d.%d, and none of python3.11 to "
        "python3.14 was found.\nInstall one (python.org, or your system's packages) and run this "
        "again." % sys.version_info[:2]
    )


def venv_program(name):
    """Path of a program inside ``.venv``."""
    folder = VENV / ("Scripts" if os.name == "nt" else "bin")
    return str(folder / (name + ".exe" if os.name == "nt" else name))


def fingerprint(python):
    """Hash of all that decides what belongs into ``.venv``."""
    version = (
        sys.version
        if python == sys.executable
        else ask([python, "-c", "import sys; print(sys.version)"])
    )
    digest = hashlib.sha256()
    for part in (str(ROOT).encode(), str(version).strip().encode()):
        digest.update(part + b"\0")
    for path in (ROOT / "pyproject.toml", CONSTRAINTS):
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()


def read_stamp():
    """Return the stamp's fingerprint and extras; empty when there is none or it is unreadable."""
    try:
        stamp = json.loads((VENV / "markermend-stamp.json").read_text(encoding="utf-8"))
        return stamp["fingerprint"], set(stamp["extras"])
    except (OSError, ValueError, KeyError, TypeError):
        return "", set()


def ensure_environment(extra):
    """Make ``.venv`` hold Markermend with one of its extras, if it does not yet.

    The stamp goes away before anything changes and comes back last, so that a set-up that was
    broken off is noticed and done again from nothing.
    """
    python = find_python()
    wanted = fingerprint(python)
    stamped, extras = read_stamp()
    usable = stamped == wanted and os.path.exists(venv_program("python"))
    if usable and (extra in extras or (extra == "app" and "dev" in extras)):
        return
    stamp = VENV / "markermend-stamp.json"
    if usable:
        stamp.unlink()
    else:
        extras = set()
        make_venv(python)
    say("Installing Markermend and what it needs into .venv (the first time only)…")
    install = [venv_program("python"), "-m", "pip", "install", "--prefer-binary"]
    if not sys.stdout.isatty():
        install += ["--quiet"]
    target = "%s[%s]" % (ROOT, extra)
    constraints = str(CONSTRAINTS)
    env = child_environment(PIP_CONSTRAINT=constraints, PIP_BUILD_CONSTRAINT=constraints)
    if subprocess.call([*install, "--editable", target], env=env, cwd=str(ROOT)) != 0:
        raise SetupError(
            "The packages could not be installed; pip's own words stand above.\n"
            "Check the network connection and run this again."
        )
    text = json.dumps({"fingerprint": wanted, "extras": sorted(extras | {extra})})
    stamp.write_text(text + "\n", encoding="utf-8")


def make_venv(python):
    """Make an empty ``.venv``, in place of whatever stood there."""
    if ask([python, "-c", "import venv, ensurepip"]) is None:
        version = ask([python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"])
        install_packages(
            ["python%s-venv" % version], "Python's venv module is missing (Debian packs it apart)."
        )
    if VENV.is_symlink() or VENV.is_file():
        VENV.unlink()
    elif VENV.exists():
        shutil.rmtree(str(VENV))
    say("Making the environment .venv…")
    if subprocess.call([python, "-m", "venv", str(VENV)], env=child_environment()) != 0:
        raise SetupError("The environment .venv could not be made; Python's words stand above.")


def is_debian():
    """Whether packages come by apt-get."""
    try:
        text = Path("/etc/os-release").read_text(encoding="utf-8")
    except OSError:
        return False
    names = " ".join(
        line.partition("=")[2].strip('"') for line in text.splitlines() if line.startswith("ID")
    )
    return shutil.which("apt-get") is not None and bool({"debian", "ubuntu"} & set(names.split()))


def install_packages(packages, why):
    """Install system packages as root on Debian or Ubuntu; else say what to install."""
    command = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
    if not is_debian():
        raise SetupError(
            "%s\nInstall with your system's package manager what Debian calls: %s"
            % (why, " ".join(packages))
        )
    if os.geteuid() != 0:
        raise SetupError(
            "%s\nInstall it and run this again:\n\n  sudo apt-get update\n  sudo %s\n"
            % (why, " ".join(command))
        )
    say("%s\n  apt-get update\n  %s" % (why, " ".join(command)))
    env = child_environment(DEBIAN_FRONTEND="noninteractive")
    for step in (["apt-get", "update"], command):
        if subprocess.call(step, env=env, stdout=subprocess.DEVNULL) != 0:
            raise SetupError("“%s” failed; its own words stand above." % " ".join(step))


def missing_libraries(libraries):
    """Return those of the named libraries that the system's loader does not find."""
    found = ask([sys.executable, "-c", _TRY_LIBRARIES, *sorted(libraries)])
    return found.split() if found else []


def ensure_libraries(display):
    """See to it that the system libraries Qt needs are there; nothing to do but on Linux."""
    if not sys.platform.startswith("linux"):
        return
    libraries = dict(OFFSCREEN_LIBRARIES)
    if display and os.environ.get("DISPLAY"):
        libraries.update(X11_LIBRARIES)
    if display and os.environ.get("WAYLAND_DISPLAY"):
        libraries.update(WAYLAND_LIBRARIES)
    missing = missing_libraries(libraries)
    if missing:
        packages = sorted({libraries[name] for name in missing})
        install_packages(packages, "Missing system libraries: %s." % ", ".join(missing))


def display_named():
    """Whether the environment speaks of a display at all."""
    if os.environ.get("QT_QPA_PLATFORM", "").split(":")[0] in ("offscreen", "minimal"):
        return False
    if not sys.platform.startswith("linux"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def display_opens():
    """Whether Qt can open the display; tried in a child, since a failure aborts the process."""
    return ask([venv_program("python"), "-c", _TRY_DISPLAY]) is not None


def run_main(main):
    """Run a script's main function; a set-up error is its text, an interrupt one word."""
    try:
        return main()
    except SetupError as error:
        print(error, file=sys.stderr)
    except KeyboardInterrupt:
        print("Stopped.", file=sys.stderr)
    return 1
