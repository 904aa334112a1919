"""A review of a hundred artifacts in the real window, by keys alone, and how many they were.

::

    xvfb-run -a -s "-screen 0 1500x940x24" \
        python tests/benchmarks/review_hundred.py TAKE [TAKE ...] [--artifacts 100] [--reject 0.05]

Each take is copied, opened by the command that an operator would type, and searched as after every
opening. From then on real key presses (``xdotool``) are all that reaches the window: **F**, and
**R** for the share of artifacts that a hand would call false, drawn by a seed. A press is counted
when it is sent. What became of it is read from the review, saved and journal, beside the copy, as
the window writes it. A press that decides nothing within some seconds is made again, and counts.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

MOST_KEYS_EACH, PATIENCE_S, OPENING_S, LOOK_S = 1.2, 20.0, 600.0, 0.01
VERBS = ("Repair ", "Accept ", "Reject ")


def ask(*arguments: str) -> str:
    """Run xdotool; what it prints, empty when it finds nothing."""
    done = subprocess.run(["xdotool", *arguments], capture_output=True, text=True, check=False)
    return done.stdout.strip()


class Review:
    """What the files beside a take say of its review.

    Parameters
    ----------
    folder : where the copy of the take lies, and nothing else
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def labels(self) -> list[str]:
        """The steps done, by name: those saved, and those journalled since."""
        saved, steps = 0, []
        for path in self._folder.glob("*.markermend.json"):
            document = json.loads(path.read_text(encoding="utf-8"))
            saved = document["generation"]
            steps = [str(step["label"]) for step in document["done"]]
        for path in self._folder.glob("*.markermend.journal"):
            lines = path.read_text(encoding="utf-8").splitlines()
            entries = [json.loads(line) for line in lines if line.endswith("}")]
            if entries and entries[0]["generation"] == saved:
                steps += [str(e["do"]["label"]) for e in entries if "do" in e]
        return steps

    def searches(self) -> int:
        """How often it was detected."""
        return sum(label.startswith("Detect (") for label in self.labels())

    def decided(self) -> int:
        """How many decisions were made."""
        return sum(label.startswith(VERBS) for label in self.labels())


def wait_for(what: Callable[[], int], least: int, seconds: float) -> bool:
    """Whether a count came to be at least so large within some seconds."""
    until = time.monotonic() + seconds
    while what() < least:
        if time.monotonic() > until:
            return False
        time.sleep(LOOK_S)
    return True


def review(take: Path, wanted: int, reject: float, settle_s: float) -> float:
    """Review a copy of a take; prints the figures and returns key presses an artifact."""
    chance = random.Random(7)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "take"
        folder.mkdir()
        copy = folder / take.name
        shutil.copy(take, copy)
        environment = {**os.environ, "XDG_CONFIG_HOME": name, "XDG_DATA_HOME": name}
        environment.pop("QT_QPA_PLATFORM", None)
        process = subprocess.Popen(
            [sys.executable, "-m", "markermend_app", str(copy)], env=environment
        )
        try:
            seen = Review(folder)
            if not wait_for(seen.searches, 1, OPENING_S):
                raise SystemExit(f"{take.name}: nothing was detected")
            window = ask("search", "--onlyvisible", "--name", "– Markermend").splitlines()[-1]
            ask("windowactivate", "--sync", window)
            time.sleep(settle_s)
            pressed: Counter[str] = Counter()
            begun, done = time.monotonic(), 0
            while done < wanted:
                key = "r" if chance.random() < reject else "f"
                pressed[key] += 1
                ask("key", key)
                if wait_for(seen.decided, done + 1, PATIENCE_S):
                    done += 1
                elif process.poll() is not None or sum(pressed.values()) > 2 * wanted:
                    break
            took = time.monotonic() - begun
            verbs = Counter(x.split()[0] for x in seen.labels() if x.startswith(VERBS))
        finally:
            process.kill()
            process.wait()
    each = sum(pressed.values()) / max(done, 1)
    good = done == wanted and each <= MOST_KEYS_EACH
    keys = ", ".join(f"{n} {key.upper()}" for key, n in sorted(pressed.items()))
    told = ", ".join(f"{n} {verb.lower()}" for verb, n in sorted(verbs.items()))
    print(  # noqa: T201
        f"{take.name}: {done} artifacts decided ({told}) by {sum(pressed.values())} keys ({keys}), "
        f"{each:.2f} each, target {MOST_KEYS_EACH:g}: {'ok' if good else 'TOO MANY'}; "
        f"{took / max(done, 1):.2f} s each",
        flush=True,
    )
    return each if done == wanted else float("inf")


def main() -> int:
    """Review the takes named; 1 when one took more keys than it may."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("takes", nargs="+", type=Path)
    parser.add_argument("--artifacts", type=int, default=100)
    parser.add_argument("--reject", type=float, default=0.05, help="share that is rejected")
    parser.add_argument("--settle", type=float, default=2.0, help="seconds before the first key")
    chosen = parser.parse_args()
    figures = [review(t, chosen.artifacts, chosen.reject, chosen.settle) for t in chosen.takes]
    return 0 if max(figures) <= MOST_KEYS_EACH else 1


if __name__ == "__main__":
    sys.exit(main())
