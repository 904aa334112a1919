"""What every test may need: where the real recordings lie, and one BLAS thread."""

from __future__ import annotations

import gc
import os
from functools import cache
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
# Some containers turn byte code off; each of the many processes would compile us anew.
os.environ["PYTHONDONTWRITEBYTECODE"] = ""

import pytest

ROOT = Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared"


def pytest_collection_finish() -> None:
    """Leave libraries and tests out of every later collection: they stay, and are many."""
    gc.collect()
    gc.freeze()


@pytest.fixture(autouse=True)
def own_user_folder(tmp_path_factory, monkeypatch):
    """Keep what would go into the user's own folders in one that is thrown away."""
    folder = cache(lambda: tmp_path_factory.mktemp("user"))
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: folder())
    monkeypatch.setattr("platformdirs.user_config_path", lambda *_, **__: folder() / "config")


@pytest.fixture(scope="module")
def restored_once():
    """Restore each recording once: many tests read, search and write the same."""
    from restoring import restore_once

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("markermend.poses.take.restore", restore_once)
        yield


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real recordings; the test skips, saying so, where it is missing."""
    folder = SHARED / "data"
    if not folder.is_dir():
        pytest.skip(f"the real recordings are not here ({folder})")
    return folder
