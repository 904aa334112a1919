"""The samples of a C3D file: frames of words turned into millimetres and back."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, ByteArray, FloatArray
from markermend.errors import ExportError, FileFormatError
from markermend.files.c3d_layout import C3dLayout, Storage
from markermend.files.c3d_numbers import decode_floats

# Blocks that stay in the processor's cache are decoded two to three times faster.
BLOCK_BYTES = 1 << 20
# Beyond 100 km there is no marker: producers write such numbers where they saw nothing.
FARTHEST_MM = 1e8
_LARGEST_WORD, _UNSIGNED_WORD = 32767, 65535


@dataclass(frozen=True)
class Plan:
    """How the words of a file become positions.

    Attributes
    ----------
    layout : the file
    columns : points to decode
    scale_mm : millimetres per word
    """

    layout: C3dLayout
    columns: tuple[int, ...]
    scale_mm: float

    @property
    def selection(self) -> slice | NDArray[np.intp]:
        """Index of the columns, a slice where they follow one another."""
        if not self.columns:
            return slice(0, 0)
        first, count = self.columns[0], len(self.columns)
        if self.columns == tuple(range(first, first + count)):
            return slice(first, first + count)
        return np.array(self.columns, dtype=np.intp)


def blocks(file: IO[bytes], layout: C3dLayout) -> Iterator[tuple[int, int, ByteArray]]:
    """Read the frames block by block.

    Parameters
    ----------
    file : opened for reading without a buffer of its own
    layout : the file

    Yields
    ------
    start, stop, raw : half-open interval of frames, and (frames, stride) uint8, which is
        overwritten by the next block

    Raises
    ------
    FileFormatError
        when the file has become shorter in the meantime
    """
    if not layout.stride:
        return
    step = max(1, BLOCK_BYTES // layout.stride)
    buffer = np.empty((min(step, layout.frames), layout.stride), dtype=np.uint8)
    file.seek(layout.data)
    for start in range(0, layout.frames, step):
        stop = min(start + step, layout.frames)
        part = buffer[: stop - start]
        view, done = part.reshape(-1).data, 0
        while done < len(view):
            got = file.readinto(view[done:])  # type: ignore[attr-defined]
            if not got:
                raise FileFormatError("The file became shorter while it was read; open it again.")
            done += got
        yield start, stop, part


def words_of(raw: ByteArray, layout: C3dLayout) -> NDArray[Any]:
    """View or decode a block: (frames, words) int16 or float32."""
    if layout.storage is Storage.INTEGER:
        return raw.view(f"{layout.processor.order}i2")
    return decode_floats(raw, layout.processor)


def quads_of(words: NDArray[Any], layout: C3dLayout) -> NDArray[Any]:
    """Points of a block: (frames, points, 4) of x, y, z, residual word."""
    return words[:, : 4 * layout.points].reshape(len(words), layout.points, 4)


def decode_positions(
    quads: NDArray[Any], plan: Plan, out: FloatArray
) -> tuple[BoolArray, NDArray[Any]]:
    """Turn the markers of a block into millimetres.

    Parameters
    ----------
    quads : (frames, points, 4) as stored
    plan : which points, and their scale
    out : (frames, markers, 3) float64, written; NaN where missing

    Returns
    -------
    missing : (frames, markers) bool
    stored : (frames, markers, 4), the words that were decoded
    """
    stored = quads[:, plan.selection]
    flat = out.reshape(-1)
    with np.errstate(invalid="ignore", over="ignore"):
        # Axis by axis the inner loop is long; over all three at once it has three steps.
        for axis in range(3):
            np.multiply(stored[..., axis], plan.scale_mm, out=out[..., axis], dtype=np.float64)
        # One pass for the usual case: no coordinate is larger than the root of all squares.
        near = bool(np.einsum("i,i->", flat, flat) < FARTHEST_MM**2)
    x, y, z = (stored[..., axis] for axis in range(3))
    missing = (x == 0) & (y == 0) & (z == 0)
    if plan.layout.residuals_hold:
        missing |= invalid(stored[..., 3])
    if not near:
        missing |= ~(np.abs(out) < FARTHEST_MM).all(axis=2)
    out[missing] = np.nan
    return missing, stored


def invalid(residual_words: NDArray[Any]) -> BoolArray:
    """Tell which residual words mark a sample as missing.

    Parameters
    ----------
    residual_words : as stored

    Returns
    -------
    bool, of the same shape: negative words, and in float files also -1 written as 65535
    """
    negative: BoolArray = residual_words < 0
    if residual_words.dtype.kind == "f":
        large = residual_words > _LARGEST_WORD
        if large.any():
            negative |= large & (residual_words <= _UNSIGNED_WORD)
    return negative


def too_far(positions: FloatArray) -> BoolArray:
    """Tell which coordinates would be read as missing once they are written.

    Parameters
    ----------
    positions : mm, of any shape; NaN is not too far

    Returns
    -------
    bool, of the same shape
    """
    with np.errstate(over="ignore", invalid="ignore"):
        # As the file's floats hold them: just below the limit rounding reaches it.
        far: BoolArray = np.abs(positions.astype(np.float32)) >= FARTHEST_MM
    return far


def far_away(label: str, frame: int, at_mm: float) -> ExportError:
    """Why a sample that is :func:`too_far` is not written."""
    return ExportError(
        f"{label} at frame {frame} is at {at_mm:.3g} mm, and what is beyond"
        f" {FARTHEST_MM / 1e6:.0f} km counts as missing in a C3D file; correct or erase it first."
    )


def decode_residuals(stored: NDArray[Any], scale_mm: float) -> tuple[FloatArray, ByteArray]:
    """Split residual words into residuals in mm and numbers of cameras.

    Parameters
    ----------
    stored : (frames, markers) residual words; negative ones mean nothing
    scale_mm : millimetres per step

    Returns
    -------
    residuals (frames, markers) float64 and cameras (frames, markers) uint8
    """
    if stored.dtype.kind == "f":
        # The word is an integer stored as a float; what is out of its range means nothing.
        inside = (stored >= 0) & (stored <= _LARGEST_WORD)
        word = np.where(inside, stored, 0).astype(np.int16)
    else:
        word = np.maximum(stored, 0).astype(np.int16)
    residuals = np.multiply(word & 0xFF, scale_mm, dtype=np.float64)
    return residuals, _BITS[word >> 8]


_BITS = np.array([bin(i).count("1") for i in range(128)], dtype=np.uint8)
