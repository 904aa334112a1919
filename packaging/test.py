"""Set Markermend up, then run its tests: ``python3 packaging/test.py [pytest arguments]``.

Everything goes into ``.venv``. No display is needed: windows are drawn off screen.
"""

import subprocess
import sys

import bootstrap


def main():
    """Prepare the environment and run pytest; returns its exit code."""
    bootstrap.ensure_environment("dev")
    bootstrap.ensure_libraries(display=False)
    env = bootstrap.child_environment(QT_QPA_PLATFORM="offscreen")
    command = [bootstrap.venv_program("python"), "-m", "pytest", "-n", "2", "-q"]
    return subprocess.call(command + sys.argv[1:], env=env, cwd=str(bootstrap.ROOT))


if __name__ == "__main__":
    sys.exit(bootstrap.run_main(main))
