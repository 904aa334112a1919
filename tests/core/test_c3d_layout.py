"""Odd C3D files of our own making: long, wide, in other units, with parameters out of order."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import markermend as mm
from markermend.files.c3d_build import (
    FLOAT,
    INTEGER,
    group_record,
    header_bytes,
    number_records,
    scalar_record,
    section_bytes,
    text_records,
)
from markermend.files.c3d_numbers import Processor, decode_floats, encode_floats
from markermend.files.units import unit_mm

INTEL = Processor.INTEL


def build(
    path: Path,
    *,
    processor: Processor = INTEL,
    frames: int = 5,
    points: int = 2,
    units: str | None = "mm",
    first_frame: int = 1,
    records: list[bytes] | None = None,
    scale: float = -0.1,
    last_is: int | None = None,
    value: float = 100.0,
    shuffle: bool = False,
) -> Path:
    """Write a small C3D file; points stand at (value + frame, value, value)."""
    own = [
        group_record(1, "POINT", "", processor),
        scalar_record(1, "USED", INTEGER, points, processor),
        scalar_record(1, "RATE", FLOAT, 50.0, processor),
        *text_records(1, "LABELS", [f"P{i}" for i in range(points)], processor),
    ]
    if units is not None:
        own += text_records(1, "UNITS", [units], processor)
    own += records or []
    if shuffle:
        own = own[1:] + own[:1]
    section = section_bytes(own, processor, path.name)
    header = header_bytes(
        b"",
        processor,
        points=points,
        analog_words=0,
        analog_per_frame=0,
        first_frame=first_frame,
        frames=frames,
        scale=scale,
        data_block=2 + len(section) // 512,
        rate=50.0,
    )
    if last_is is not None:
        header = header[:8] + struct.pack(f"{processor.order}H", last_is) + header[10:]
    quads = np.zeros((frames, points, 4), dtype=np.float32)
    quads[..., :3] = value
    quads[..., 0] += np.arange(frames, dtype=np.float32)[:, None]
    if scale > 0:
        data = np.rint(quads / scale).astype(f"{processor.order}i2").tobytes()
    else:
        data = encode_floats(quads.reshape(-1), processor).tobytes()
    path.write_bytes(header + section + data)
    return path


@pytest.mark.parametrize("processor", Processor)
@pytest.mark.parametrize("scale", [-0.1, 0.1])
def test_every_processor_and_storage(tmp_path: Path, processor: Processor, scale: float) -> None:
    take = mm.read(build(tmp_path / "a.c3d", processor=processor, scale=scale))
    np.testing.assert_allclose(take.positions[:, 1, 0], 100 + np.arange(5), atol=1e-5)
    mm.write(take, tmp_path / "b.c3d")
    assert (tmp_path / "a.c3d").read_bytes() == (tmp_path / "b.c3d").read_bytes()


@pytest.mark.parametrize(
    ("units", "value", "expected"),
    [
        ("mm", 100.0, 100.0),
        ("m", 1.5, 1500.0),
        ("mete", 1.5, 1500.0),
        ("cm", 150.0, 1500.0),
        ("in", 10.0, 254.0),
        ("inches", 10.0, 254.0),
        ("Millimeters", 100.0, 100.0),
        ("", 1.5, 1500.0),
        (None, 1000.0, 1000.0),
        ("wavelengths", 1000.0, 1000.0),
    ],
)
def test_units(tmp_path: Path, units: str | None, value: float, expected: float) -> None:
    take = mm.read(build(tmp_path / "a.c3d", units=units, value=value))
    assert take.positions[0, 0, 1] == pytest.approx(expected)
    assert bool(take.warnings) == (unit_mm(units or "") is None)
    positions = take.positions.copy()
    positions[2, 1] = [1.0, 2.0, 3.0]
    mm.write(take.with_positions(positions, take.origin.copy()), tmp_path / "b.c3d")
    np.testing.assert_allclose(mm.read(tmp_path / "b.c3d").positions, positions, rtol=1e-6)


@pytest.mark.parametrize(
    "records",
    [
        [scalar_record(1, "LONG_FRAMES", FLOAT, 70_000, INTEL)],
        [scalar_record(1, "FRAMES", FLOAT, 70_000, INTEL)],
        [
            group_record(2, "TRIAL", "", INTEL),
            *number_records(2, "ACTUAL_START_FIELD", INTEGER, [1, 0], INTEL),
            *number_records(2, "ACTUAL_END_FIELD", INTEGER, [70_000 & 0xFFFF, 1], INTEL),
        ],
    ],
    ids=["long frames", "frames as a float", "trial's fields"],
)
def test_more_frames_than_the_header_can_tell(tmp_path: Path, records: list[bytes]) -> None:
    path = build(tmp_path / "a.c3d", frames=70_000, points=1, records=records)
    take = mm.read(path)
    assert (take.frames, take.read_only) == (70_000, False)
    path.write_bytes(path.read_bytes()[:-16_000])
    cut = mm.read(path)
    assert (cut.frames, cut.read_only) == (69_000, True)
    assert any("70000" in w and "69000" in w for w in cut.warnings)


def test_unsigned_counts(tmp_path: Path) -> None:
    records = [scalar_record(1, "FRAMES", INTEGER, 40_000, INTEL)]
    take = mm.read(build(tmp_path / "a.c3d", frames=40_000, points=1, records=records))
    assert take.frames == 40_000


def test_one_frame_and_first_frame(tmp_path: Path) -> None:
    take = mm.read(build(tmp_path / "a.c3d", frames=1, first_frame=0))
    assert (take.frames, take.first_frame, take.analog) == (1, 0, None)


def test_more_than_255_labels(tmp_path: Path) -> None:
    take = mm.read(build(tmp_path / "a.c3d", points=600))
    assert take.labels[254:257] == ("P254", "P255", "P256")
    assert take.labels[-1] == "P599"


def test_group_after_its_parameters(tmp_path: Path) -> None:
    assert mm.read(build(tmp_path / "a.c3d", shuffle=True)).labels == ("P0", "P1")


def test_parameters_of_the_wrong_type(tmp_path: Path) -> None:
    records = [
        group_record(2, "EVENT", "", INTEL),
        *text_records(2, "TIMES", ["now"], INTEL),
        scalar_record(2, "USED", FLOAT, float("1e30"), INTEL),
        group_record(3, "ANALOG", "", INTEL),
        *text_records(3, "USED", ["many"], INTEL),
        *text_records(1, "FRAMES", ["some"], INTEL),
    ]
    take = mm.read(build(tmp_path / "a.c3d", records=records))
    assert (take.frames, take.events) == (5, ())


def test_header_that_counts_frames_wrongly(tmp_path: Path) -> None:
    records = [scalar_record(1, "FRAMES", INTEGER, 300, INTEL)]
    take = mm.read(build(tmp_path / "a.c3d", frames=300, records=records, last_is=200))
    assert take.frames == 300
    assert any("200" in w and "300" in w for w in take.warnings)


def test_minus_one_without_sign(tmp_path: Path) -> None:
    path = build(tmp_path / "a.c3d")
    raw = bytearray(path.read_bytes())
    raw[-4:] = struct.pack("<f", 65535.0)
    path.write_bytes(raw)
    take = mm.read(path)
    assert not take.present[-1, -1]
    assert take.present.sum() == 9


def test_known_dec_numbers() -> None:
    # 1.0, -0.5 and 12345.678 as a VAX stores them: half the sign and exponent come first.
    raw = np.array([0x80, 0x40, 0, 0, 0, 0xC0, 0, 0], dtype=np.uint8)
    np.testing.assert_array_equal(decode_floats(raw, Processor.DEC), [1.0, -0.5])
    np.testing.assert_array_equal(encode_floats(np.float32([1.0, -0.5]), Processor.DEC), raw)


@given(
    arrays(
        np.float32,
        st.integers(1, 30),
        elements=st.floats(-(2.0**126), 2.0**126, width=32, allow_subnormal=False),
    ),
    st.sampled_from(Processor),
)
def test_numbers_survive_every_processor(values: np.ndarray, processor: Processor) -> None:
    back = decode_floats(encode_floats(values, processor), processor)
    np.testing.assert_array_equal(back, values)


def test_numbers_a_dec_float_cannot_hold() -> None:
    for value in (np.inf, np.nan, 3e38):
        with pytest.raises(OverflowError):
            encode_floats(np.float32([value]), Processor.DEC)
