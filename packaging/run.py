"""Set Markermend up, then start it: ``python3 packaging/run.py [TAKE]``.

Everything goes into ``.venv``. Without a take the bundled demo opens; without a display the take
is cleaned headless, with a picture of the review window beside the result.
"""

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import bootstrap

DEMO = bootstrap.ROOT / "resources" / "markermend_resources" / "demo" / "demo.c3d"
RESULTS = bootstrap.ROOT / "build" / "review"


def main():
    """Prepare the environment and open the take; returns an exit code."""
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        print(__doc__)
        return 0 if len(sys.argv) == 2 else 2
    take = Path(sys.argv[1]).absolute() if len(sys.argv) > 1 else DEMO
    if not take.is_file():
        raise bootstrap.SetupError("There is no file %s." % take)
    bootstrap.ensure_environment("app")
    display = bootstrap.display_named()
    bootstrap.ensure_libraries(display)
    if not (display and bootstrap.display_opens()):
        return clean_headless(take)
    print("Opening %s…" % take.name, flush=True)
    command = [bootstrap.venv_program("python"), "-m", "markermend_app", str(take)]
    return subprocess.call(command, env=bootstrap.child_environment())


def clean_headless(take):
    """Do the main job without a window: detect, repair, export, and picture the review."""
    start = time.monotonic()
    bootstrap.say("There is no display here, so %s is cleaned without a window." % take.name)
    RESULTS.mkdir(parents=True, exist_ok=True)
    clean = RESULTS / (take.stem + "_clean" + take.suffix)
    artifacts = RESULTS / (take.stem + "_artifacts.json")
    picture = RESULTS / (take.stem + "_review.png")
    python = bootstrap.venv_program("python")
    clean_take = [bootstrap.venv_program("markermend"), "clean", str(take), "--force"]
    with tempfile.TemporaryDirectory() as folder:
        # The window keeps its review beside the take, and its layout in the settings: those of
        # the copy go away with it. Off screen Qt warns of what nobody there could miss.
        copy = shutil.copy(str(take), folder)
        env = bootstrap.child_environment(
            QT_QPA_PLATFORM="offscreen",
            QT_LOGGING_RULES="default.warning=false",
            XDG_CONFIG_HOME=folder,
        )
        for step in (
            [*clean_take, "--output", str(clean), "--json", str(artifacts)],
            [python, "-m", "markermend_app", copy, "--screenshot", str(picture)],
        ):
            code = subprocess.call(step, env=env)
            if code != 0:
                return code
    bootstrap.say("\nDone in %.0f s:" % (time.monotonic() - start))
    for what, path in (
        ("cleaned take", clean),
        ("what was found and done", artifacts),
        ("picture of the window", picture),
    ):
        bootstrap.say("  %-24s %s" % (what, path))
    return 0


if __name__ == "__main__":
    sys.exit(bootstrap.run_main(main))
