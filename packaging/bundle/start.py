"""What a bundle runs: the command line, or the window when called by that name."""

import multiprocessing
import runpy
import sys
from pathlib import Path

WINDOW = "markermend-window"
OWN_MODULES = ("joblib.externals.loky.", "markermend.plugins.serve")
"""Programs that our own processes are, of joblib and for plugins."""


def child_of_ours(arguments):
    """Become a worker, whose parent calls us as if we were Python; False if we are none.

    A frozen program is its own interpreter, so ``-m module`` and ``-c code`` arrive here.
    """
    # Options of the interpreter (-B, -E…) come first.
    while arguments and arguments[0].startswith("-") and arguments[0] not in ("-c", "-m"):
        arguments = arguments[1:]
    if len(arguments) < 2:
        return False
    option, what = arguments[0], arguments[1]
    if option == "-m" and what.startswith(OWN_MODULES):
        sys.argv = arguments[1:]
        runpy.run_module(what, run_name="__main__", alter_sys=True)
        return True
    if option == "-c" and what.startswith("from joblib.externals.loky."):
        sys.argv = ["-c", *arguments[2:]]
        exec(what, {"__name__": "__main__"})
        return True
    return False


def main():
    """Start what we were called for; returns the exit code."""
    multiprocessing.freeze_support()
    if child_of_ours(sys.argv[1:]):
        return 0
    if Path(sys.argv[0]).stem == WINDOW:
        from markermend_app.main import main as window

        return window(sys.argv[1:])
    from markermend.cli import main as command

    return command()


if __name__ == "__main__":
    sys.exit(main())
