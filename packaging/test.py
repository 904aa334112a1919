"""Set Markermend up, then run its tests: ``python3 packaging/test.py [--deep] [pytest arguments]``.

Everything goes into ``.venv``. No display is needed: windows are drawn off screen. With ``--deep``
the optional extra of that name is installed too, and its tests are run.
"""

import subprocess
import sys

import bootstrap


def main():
    """Prepare the environment and run pytest; returns its exit code."""
    arguments = sys.argv[1:]
    bootstrap.ensure_environment("dev")
    if "--deep" in arguments:
        arguments.remove("--deep")
        bootstrap.ensure_environment("deep")
        arguments = ["-m", "deep", *arguments]
    bootstrap.ensure_libraries(display=False)
    # Some containers turn byte code off; each of the many processes would compile us anew.
    env = bootstrap.child_environment(QT_QPA_PLATFORM="offscreen", PYTHONDONTWRITEBYTECODE="")
    command = [bootstrap.venv_program("python"), "-m", "pytest", "-n", "2", "-q"]
    return subprocess.call(command + arguments, env=env, cwd=str(bootstrap.ROOT))


if __name__ == "__main__":
    sys.exit(bootstrap.run_main(main))
