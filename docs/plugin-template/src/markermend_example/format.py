"""A file format: positions, labels and rate in a NumPy archive."""

import io

import numpy as np

from markermend.plugins.formats import Format
from markermend.take import Take


def read_npz(path):
    """Read a take from ``.npz``."""
    with np.load(path, allow_pickle=False) as file:
        labels = tuple(str(label) for label in file["labels"])
        return Take(file["positions"], labels, float(file["rate"]))


def write_npz(take):
    """Return the contents of an ``.npz`` file."""
    file = io.BytesIO()
    np.savez_compressed(file, positions=take.positions, labels=take.labels, rate=take.rate)
    return file.getvalue()


npz = Format(name="npz", label="NumPy archive", run=read_npz, write=write_npz)
