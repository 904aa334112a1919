"""A review as it stands at one moment, to be written on any thread."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from markermend.artifact import Artifact
from markermend.artifact_json import to_dict
from markermend.errors import MarkermendError
from markermend.review.left_at import LeftAt, left_at_to_dict
from markermend.review.step import Step
from markermend.review.steps_json import step_to_dict


@dataclass(frozen=True)
class Snapshot:
    """What a session file is to hold, and how far the review had come.

    Attributes
    ----------
    path : of the session file
    part : where it is written first, beside it
    revision, generation : of the session, and what the file's will be
    head : what the file says of itself and its take
    artifacts, done, undone, exported, left_at : of the session
    """

    path: Path
    part: Path
    revision: int
    generation: int
    head: Mapping[str, Any]
    artifacts: tuple[Artifact, ...]
    done: tuple[Step, ...]
    undone: tuple[Step, ...]
    exported: int | None
    left_at: LeftAt | None

    def write(self) -> None:
        """Write it beside the session file, and bring it to the disk; takes long.

        Raises
        ------
        MarkermendError
            when it cannot be written; nothing is left of it then
        """
        document = {
            **self.head,
            "generation": self.generation,
            "artifacts": [to_dict(a) for a in self.artifacts],
            "done": [step_to_dict(s) for s in self.done],
            "undone": [step_to_dict(s) for s in self.undone],
            "exported": self.exported,
            "at": left_at_to_dict(self.left_at),
        }
        try:
            with self.part.open("w", encoding="utf-8") as file:
                # Not json.dump, which writes piece by piece and takes several times as long.
                file.write(json.dumps(document, allow_nan=False))
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            self.discard()
            raise self._failed(error) from error

    def put_in_place(self) -> None:
        """Let what was written be the session file; errors as in :meth:`write`."""
        try:
            os.replace(self.part, self.path)
        except OSError as error:
            self.discard()
            raise self._failed(error) from error

    def discard(self) -> None:
        """Forget what was written."""
        with contextlib.suppress(OSError):
            self.part.unlink(missing_ok=True)

    def _failed(self, error: OSError) -> MarkermendError:
        return MarkermendError(
            f"The review could not be saved to “{self.path}” ({error.strerror})."
        )
