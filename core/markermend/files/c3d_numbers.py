"""Numbers as C3D files store them: three byte orders, and DEC's own floating point."""

from __future__ import annotations

from enum import IntEnum

import numpy as np

from markermend.arrays import ByteArray, Float32Array

# A DEC F float is an IEEE single with its 16-bit halves swapped and an exponent greater by 2.
_EXPONENT_STEP = np.uint32(2 << 23)
_SMALLEST_DEC = np.uint32(3 << 23)
_LARGEST_IEEE = np.uint32(254 << 23)
_MAGNITUDE = np.uint32(0x7FFFFFFF)


class Processor(IntEnum):
    """Kind of computer whose byte order a C3D file uses, by its code in the file."""

    INTEL = 84
    DEC = 85
    MIPS = 86

    @property
    def order(self) -> str:
        """NumPy's sign of the byte order of 16-bit integers."""
        return ">" if self is Processor.MIPS else "<"


def decode_floats(raw: ByteArray, processor: Processor) -> Float32Array:
    """Turn stored 32-bit floats into native ones.

    Parameters
    ----------
    raw : (4 n,) uint8, or any contiguous array of bytes whose last axis is a multiple of 4
    processor : how the file stores them

    Returns
    -------
    float32, last axis a quarter as long; a view of ``raw`` for Intel files. DEC values nearer to
    zero than 5.9e-39 come back as zero.
    """
    if processor is Processor.INTEL:
        return raw.view("<f4")
    if processor is Processor.MIPS:
        return raw.view(">f4").astype(np.float32)
    halves = raw.view("<u2").astype(np.uint32)
    bits = (halves[..., 0::2] << np.uint32(16)) | halves[..., 1::2]
    small = (bits & _MAGNITUDE) < _SMALLEST_DEC
    bits -= _EXPONENT_STEP
    bits[small] = 0
    return bits.view(np.float32)


def encode_floats(values: Float32Array, processor: Processor) -> ByteArray:
    """Turn native floats into stored ones; the inverse of :func:`decode_floats`.

    Parameters
    ----------
    values : (n,) float32
    processor : how the file stores them

    Returns
    -------
    (4 n,) uint8

    Raises
    ------
    OverflowError
        when a value is not finite, or too large for a DEC float
    """
    values = np.ascontiguousarray(values, dtype=np.float32)
    if processor is Processor.INTEL:
        return values.astype("<f4").view(np.uint8)
    if processor is Processor.MIPS:
        return values.astype(">f4").view(np.uint8)
    bits = values.view(np.uint32)
    magnitude = bits & _MAGNITUDE
    if (magnitude >= _LARGEST_IEEE).any():
        raise OverflowError("too large for a DEC float")
    grown = np.where(magnitude < np.uint32(1 << 23), np.uint32(0), bits + _EXPONENT_STEP)
    halves = np.empty((len(values), 2), dtype="<u2")
    halves[:, 0] = grown >> np.uint32(16)
    halves[:, 1] = grown & np.uint32(0xFFFF)
    return halves.view(np.uint8).reshape(-1)
