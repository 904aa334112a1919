"""Reading C3D: every real file opens or is refused, and agrees with two other readers."""

from __future__ import annotations

import itertools
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.files.c3d_layout import C3dLayout

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"
FILES = sorted(p for p in SHARED.rglob("*") if p.suffix.lower() == ".c3d")
REFUSED = {"Empty.c3d": "is empty"}

# Why ezc3d cannot be asked about a file.
NOT_EZC3D = {
    "Eb015si.c3d": "it does not read MIPS",
    "Eb015sr.c3d": "it does not read MIPS",
    "sgi_int.c3d": "it does not read MIPS",
    "sgi_real.c3d": "it does not read MIPS",
    "MACsample.c3d": "it does not read MIPS",
    "Dance.c3d": "its ANALOG:OFFSET is a float, which ezc3d refuses",
    "golfswing.c3d": "its ANALOG:OFFSET is a float, which ezc3d refuses",
    "BKINtechnologies.c3d": "refused as not standard, after most of a minute",
    "bad_parameter_section.c3d": "refused as not standard, or kills the interpreter",
    "badParameterOffset.c3d": "refused as not standard",
    "mocap36.c3d": "refused as not standard",
    "phasespace_sample.c3d": "comes back silently empty",
    "evart.c3d": "takes the analog rate from ANALOG:RATE, which contradicts the frames",
}
# Why the c3d package cannot be asked about a file.
NOT_PYC3D = {
    "ART-Human_real.c3d": "an empty ANALOG:RATE stops it",
    "C3DRotationExample.c3d": "an empty ANALOG:RATE stops it",
    "AlbertoINT.c3d": "an empty ANALOG:OFFSET stops it",
    "sample_probing_acromion_R.c3d": "an empty ANALOG:SCALE stops it",
    "sample_static.c3d": "an empty ANALOG:SCALE stops it",
    "FP1.C3D": "it insists on a consistent analog count",
    "FP2.C3D": "it insists on a consistent analog count",
    "MotionMonitorC3D.c3d": "it insists on a consistent analog count",
    "evart.c3d": "it insists on a consistent analog rate",
    "MACsample.c3d": "it insists on a consistent scale",
    "badParameterOffset.c3d": "its parameters stop it",
    "bad_parameter_section.c3d": "its parameters stop it",
    "mocap36.c3d": "its parameters stop it",
    "PiG_Calibration-FlatFoot-Full.c3d": "duplicate parameters stop it",
    "PiG_Calibration-FlatFoot-One.c3d": "duplicate parameters stop it",
    "PiG_Motion-FlatFoot-One.c3d": "duplicate parameters stop it",
    "admarche2.c3d": "it takes residual words beyond 16 bits for negative",
}
# Files whose residuals mark every sample invalid; we read their coordinates, the others none.
RESIDUALS_MEAN_NOTHING = {"basketball.c3d", "giant.c3d", "golf.c3d"}
# The c3d package takes no account of unsigned samples, or of ANALOG:GEN_SCALE.
PYC3D_ANALOG_DIFFERS = {"16bitanalog.c3d", "Analysis.c3d", "Dance.c3d", "golfswing.c3d"}

every_file = pytest.mark.parametrize("path", FILES, ids=lambda p: p.name)


def opened(path: Path) -> mm.Take:
    if path.name in REFUSED:
        pytest.skip("refused, see test_refused")
    return mm.read(path)


def all_points(take: mm.Take) -> np.ndarray:
    """Every point of the file in its own units, (frames, points, 3)."""
    assert take.source is not None
    layout = take.source.layout
    assert isinstance(layout, C3dLayout)
    values = np.full((take.frames, layout.points, 3), np.nan)
    values[:, list(take.source.columns)] = take.positions / (take.source.scale_mm / layout.scale)
    if take.points is not None:
        values[:, list(take.points.columns)] = take.points.values
    return values


def assert_agree(ours: np.ndarray, theirs: np.ndarray, name: str) -> None:
    """Same values where both have some; missing in one only where that is a known choice."""
    absent, gone = np.isnan(ours).any(axis=-1), np.isnan(theirs).any(axis=-1)
    both = ~absent & ~gone
    np.testing.assert_allclose(ours[both], theirs[both], rtol=1e-6, atol=1e-6)
    zeros_only = (theirs[absent & ~gone] == 0).all()
    assert zeros_only, "only points at exactly (0, 0, 0) are missing here and present there"
    if name not in RESIDUALS_MEAN_NOTHING:
        assert not (gone & ~absent).any()


@every_file
def test_opens_or_is_refused_in_one_sentence(path: Path) -> None:
    if path.name in REFUSED:
        with pytest.raises(mm.FileFormatError, match=REFUSED[path.name]) as caught:
            mm.read(path)
        assert path.name in str(caught.value)
        return
    take = mm.read(path)
    assert take.frames > 0
    assert take.source is not None
    assert take.source.size == path.stat().st_size
    assert not take.read_only
    for warning in take.warnings:
        assert warning.endswith(".")


@every_file
def test_agrees_with_ezc3d(path: Path) -> None:
    if path.name in NOT_EZC3D:
        pytest.skip(NOT_EZC3D[path.name])
    take = opened(path)
    ezc3d = pytest.importorskip("ezc3d")
    theirs = ezc3d.c3d(str(path))
    points = np.transpose(theirs["data"]["points"], (2, 1, 0))[..., :3]
    assert_agree(all_points(take), points, path.name)
    analog = theirs["data"]["analogs"][0].T
    if take.analog is not None:
        np.testing.assert_allclose(take.analog.values, analog, rtol=1e-6, atol=1e-6)
    if take.markers:
        assert take.rate == pytest.approx(theirs["header"]["points"]["frame_rate"])


@every_file
def test_agrees_with_pyc3d(path: Path) -> None:
    if path.name in NOT_PYC3D:
        pytest.skip(NOT_PYC3D[path.name])
    take = opened(path)
    c3d = pytest.importorskip("c3d")
    ours = all_points(take)
    with path.open("rb") as handle, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        # It decodes frame by frame in Python; the first ones show any difference.
        for i, (_, points, analog) in enumerate(
            itertools.islice(c3d.Reader(handle).read_frames(), 10)
        ):
            theirs = np.where(points[:, 3:4] < 0, np.nan, points[:, :3])
            assert_agree(ours[i], theirs, path.name)
            if take.analog is not None and path.name not in PYC3D_ANALOG_DIFFERS:
                each = len(take.analog.values) // take.frames
                mine = take.analog.values[i * each : (i + 1) * each].T
                np.testing.assert_allclose(mine, analog, rtol=1e-5, atol=1e-5)


def test_same_recording_in_six_codings(shared_data: Path) -> None:
    takes = [
        mm.read(shared_data / f"formats/Eb015{k}.c3d") for k in ("pi", "pr", "si", "sr", "vi", "vr")
    ]
    for take in takes[1:]:
        np.testing.assert_allclose(take.positions, takes[0].positions, atol=2e-3)
        assert take.labels == takes[0].labels
        assert take.events == takes[0].events
        np.testing.assert_array_equal(take.cameras, takes[0].cameras)


def test_zeros_and_no_numbers_are_missing(shared_data: Path) -> None:
    take = mm.read(shared_data / "props/sample_static.c3d")
    assert (~take.present).sum() == 5883
    assert any("no numbers" in w for w in take.warnings)
    assert take.info["missing_samples"] == "no place in a room (5883 samples)"
    take = mm.read(shared_data / "formats/parameterOverflow.c3d")
    assert any("(0, 0, 0)" in w for w in take.warnings)
    assert "(0, 0, 0)" in take.info["missing_samples"]


def test_minus_one_without_sign_is_missing(shared_data: Path) -> None:
    take = mm.read(shared_data / "bodies/03_rolling.c3d")
    assert take.first_frame == 1368
    assert take.rate == 175.0
    assert (~take.present).sum() == 35965
    assert any("65535" in w for w in take.warnings)
    assert "65535" in take.info["missing_samples"]
    assert take.residuals is not None
    assert np.nanmax(take.residuals) < 5.0


def test_invalid_everywhere_is_read_as_valid(shared_data: Path) -> None:
    take = mm.read(shared_data / "formats/giant.c3d")
    assert 0.8 < take.present.mean() < 0.85
    assert np.nanmax(np.abs(take.positions)) < 1e5, "metres were recognised, -1e9 is missing"
    assert take.residuals is None
    assert len(set(take.labels)) == take.markers
    assert any("invalid" in w for w in take.warnings)


def test_model_outputs_are_not_markers(shared_data: Path) -> None:
    take = mm.read(shared_data / "gait/PiG_Motion-FlatFoot-Full.c3d")
    assert take.points is not None
    assert take.markers + len(take.points.labels) == 193
    kinds = dict(zip(take.points.labels, take.points.kinds, strict=True))
    assert kinds["LHipAngles"] == "angle"
    assert kinds["LKneeMoment"] == "moment"
    assert kinds["PELO"] == "modelled"
    units = {"angle": "deg", "force": "N", "moment": "Nmm", "power": "W", "modelled": "mm"}
    assert take.points.units == units
    assert {"LASI", "RTOE", "LHEE", "C7"} <= set(take.labels)
    assert len(take.events) == 12
    assert {e.label for e in take.events} == {"Foot Strike", "Foot Off"}
    assert {e.context for e in take.events} == {"Left", "Right"}


@pytest.mark.parametrize(
    ("name", "largest_mm"),
    [("FP1.C3D", 2000), ("FP_Type1.c3d", 2000), ("sprintbasket.c3d", 10000), ("golf.c3d", 4000)],
)
def test_metres_become_millimetres(shared_data: Path, name: str, largest_mm: float) -> None:
    take = mm.read(next(shared_data.rglob(name)))
    assert 1000 < np.nanpercentile(np.abs(take.positions), 99) < largest_mm


def test_what_is_not_c3d(tmp_path: Path) -> None:
    for name, content in (("short.c3d", b"\2P"), ("text.c3d", b"hello " * 1000)):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(mm.FileFormatError, match=name):
            mm.read(tmp_path / name)
    with pytest.raises(mm.FileFormatError, match="There is no file"):
        mm.read(tmp_path / "none.c3d")
    with pytest.raises(mm.FileFormatError, match="is a folder"):
        mm.read(tmp_path)


def test_reading_needs_numpy_only(shared_data: Path) -> None:
    script = (
        "import sys, markermend as mm\n"
        "mm.read(sys.argv[1])\n"
        "heavy = {'scipy', 'sklearn', 'ezc3d', 'joblib', 'PySide6'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    source = shared_data / "bodies/85_02.c3d"
    subprocess.run([sys.executable, "-c", script, str(source)], check=True)
