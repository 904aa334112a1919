"""Damage real C3D files at random and read them: only our own errors, quickly, in bounded memory.

By hand, for as long as wanted, with a seed of its own::

    python tests/core/fuzz_c3d.py --minutes 60 --seed 1

The suite runs the same for a moment (``test_c3d_fuzz.py``).
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
import traceback
import tracemalloc
import warnings
import zlib
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.files.info import describe_file
from markermend.files.restructure import crop, relabel

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"
SLOWEST_S = 2.0
# A 16-bit integer file grows sixfold as float64 positions and residuals; the rest is fixed costs.
MEMORY_PER_BYTE = 20
MEMORY_FIXED = 8 << 20
INTERESTING = (0, 1, 2, 127, 128, 254, 255)


def mutate(raw: bytes, rng: np.random.Generator) -> bytes:
    """Change, cut, repeat or swap some bytes, mostly where header and parameters are."""
    data = bytearray(raw)
    head = min(len(data), 512 * max(2, data[16] + 256 * (data[17] & 3)))
    for _ in range(int(rng.integers(1, 8))):
        where = rng.random()
        span = 512 if where < 0.3 else head if where < 0.85 else len(data)
        at = int(rng.integers(0, max(1, min(span, len(data)))))
        match int(rng.integers(0, 7)):
            case 0:
                data[at] = int(rng.integers(0, 256))
            case 1:
                data[at] = INTERESTING[int(rng.integers(0, len(INTERESTING)))]
            case 2:
                data[at] ^= 1 << int(rng.integers(0, 8))
            case 3:
                data[at : at + 2] = int(rng.integers(0, 65536)).to_bytes(2, "little")
            case 4:
                data[at : at + 4] = rng.bytes(4)
            case 5:
                length = int(rng.integers(1, 40))
                other = int(rng.integers(0, max(1, min(span, len(data)))))
                data[at : at + length] = data[other : other + length]
            case 6 if rng.random() < 0.3:
                del data[at if rng.random() < 0.5 else int(rng.integers(0, len(data))) :]
                if not data:
                    break
    return bytes(data)


def check(data: bytes, path: Path) -> str:
    """Read damaged bytes; returns ``opened`` or ``refused``, raises where a promise is broken."""
    path.write_bytes(data)
    tracemalloc.start()
    began = time.process_time()
    outcome, said = "refused", ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            take = mm.read(path)
        outcome = "opened"
    except mm.MarkermendError as error:
        said = str(error)
    took = time.process_time() - began
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert "\n" not in said, said
    assert took < SLOWEST_S, f"took {took:.1f} s"
    assert peak < MEMORY_FIXED + MEMORY_PER_BYTE * len(data), f"took {peak >> 20} MiB"
    if outcome == "opened" and rng_of(data).random() < 0.1:
        target = path.with_suffix(".out.c3d")
        mm.write(take, target)
        assert target.read_bytes() == data, "exported without edits, yet not the same"
        if take.markers:
            try:
                mm.write(relabel(take, {take.labels[0]: "A name"}), target)
                mm.write(crop(take, take.frames // 2, take.frames), target)
                assert mm.read(target).frames == take.frames - take.frames // 2
            except mm.ExportError as error:
                said = str(error)
        json.dumps(describe_file(take))
    return outcome


def rng_of(data: bytes) -> np.random.Generator:
    """Generator that depends on the bytes alone, so that a finding can be repeated."""
    return np.random.default_rng(zlib.crc32(data))


def samples() -> list[Path]:
    """Every real C3D file that is not empty."""
    found = (p for p in SHARED.rglob("*") if p.suffix.lower() == ".c3d")
    return sorted(p for p in found if p.stat().st_size)


def main() -> int:
    """Run until the time is up; keep what broke a promise in the current folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    files = [(p.name, p.read_bytes()) for p in samples()]
    counts = {"opened": 0, "refused": 0, "broken": 0}
    until = time.monotonic() + 60 * arguments.minutes
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() < until:
            name, raw = files[int(rng.integers(len(files)))]
            data = mutate(raw, rng)
            try:
                counts[check(data, Path(folder) / name)] += 1
            except Exception:
                counts["broken"] += 1
                kept = Path(f"broken-{counts['broken']}-{name}")
                kept.write_bytes(data)
                sys.stderr.write(f"{kept}\n{traceback.format_exc()}\n")
    sys.stdout.write(f"{counts}\n")
    return 1 if counts["broken"] else 0


if __name__ == "__main__":
    sys.exit(main())
