"""When poses of a stream go out, and what is said of joints that never come."""

from __future__ import annotations

import pytest
from command_line import run

from markermend.files.pose_stream import follow

RATE = 4
HEAD = "frame,time,joint,parent,x,y,z,qx,qy,qz,qw,confidence"
PARENT = {"a": "", "b": "a", "c": "b", "d": "c"}
LATE = (
    "A row of “d” came after its pose had gone out, and was left out; write rows of unseen joints"
    " too, with confidence 0, and none will."
)


def row(frame, joint, sure=1):
    z = 100 * list(PARENT).index(joint)
    return f"{frame},{frame / RATE},{joint},{PARENT[joint]},{frame},10,{z},0,0,0,1,{sure}"


def streamed(poses):
    """What came of poses, each some joints in order; capital ones are unseen.

    Returns
    -------
    of each pose that went out, of which frame was the last row that had come; lines; sentences
    """
    came, out, said = [-1], [], []

    def source():
        yield HEAD
        for frame, joints in enumerate(poses):
            for joint in joints:
                came.append(frame)
                yield row(frame, joint.lower(), int(joint.islower()))

    def write(text):
        out.append((came[-1], text))

    count = follow(source(), write, rate=RATE, prior=None, warn=said.append)
    assert count == len(out) - 1 == len(poses)
    lines = [text.splitlines() for _, text in out[1:]]
    assert [int(pose[0].split(",")[0]) for pose in lines] == list(range(len(poses)))
    return [when for when, _ in out[1:]], lines, said


def confidence(lines, joint):
    at = list(PARENT).index(joint)
    return [float(pose[at].rsplit(",", 1)[1]) for pose in lines]


def test_the_last_joint_is_waited_for_no_longer_than_a_second():
    when, lines, said = streamed(["abcd"] * 6 + ["abc"] * 8)
    # All rows come in the last pose's first, and none is held back after a second.
    assert when == [1, 1, 2, 3, 4, 5, 7, 8, 9, 10, 10, 11, 12, 13]
    assert confidence(lines, "d") == [1.0] * 6 + [0.5] * 8
    assert said == []


def test_the_others_are_not_waited_for_where_rows_come_in_order():
    when, _, _ = streamed(["abcd"] * 6 + ["acd"] * 3 + ["ad"] * 3)
    assert when == [1, *range(1, 12)]


@pytest.mark.parametrize("other", ["dcba", "bacd"])
def test_no_order_is_relied_on_before_it_was_kept(other):
    poses = ["abcd", other, "abcd", other, "abcd", other, "abcd"]
    when, lines, said = streamed(poses)
    assert when == [1, 1, 2, 3, 4, 5, 6]
    assert said == []
    assert all(set(confidence(lines, joint)) == {1.0} for joint in "abcd")


def test_who_comes_back_too_late_counts_from_the_next_pose():
    when, lines, said = streamed(["abcd"] * 6 + ["abc"] * 8 + ["abcd"] * 6)
    assert said == [LATE]
    assert confidence(lines, "d") == [1.0] * 6 + [0.5] * 9 + [1.0] * 5
    assert when[10:] == list(range(10, 20))


def test_who_comes_back_soon_is_never_late():
    when, lines, said = streamed(["abcd"] * 6 + ["abc", "abcd", "abc", "abc"] * 3)
    assert said == []
    assert confidence(lines, "d")[6:] == [0.5, 1.0, 0.5, 0.5] * 3
    assert max(late - n for n, late in enumerate(when)) == 1


def test_with_rows_of_unseen_joints_nothing_is_held_back():
    when, lines, _ = streamed(["abcd"] * 2 + ["abcD"] * 3 + ["aBCd"] * 3)
    assert when == [1, *range(1, 8)]
    assert confidence(lines, "c") == [1.0] * 5 + [0.5] * 3


def test_what_is_not_seen_for_three_seconds_is_said_at_once():
    said = []

    def source():
        yield HEAD
        for frame in range(20):
            # The first pose waits for the second one.
            assert bool(said) == (frame > 3 * RATE - 1)
            for joint in "abcD":
                yield row(frame, joint.lower(), int(joint.islower()))

    out = []
    follow(source(), out.append, rate=RATE, prior=None, warn=said.append)
    assert said == ["Not seen in the first 3 s: d. They are filled once they were seen."]
    assert confidence([text.splitlines() for text in out[1:]], "d") == [0.0] * 20


def test_what_is_never_seen_is_said_of_short_streams_too():
    _, lines, said = streamed(["abcD"] * 3 + ["abCD"])
    assert said == ["Never seen, and left so: d."]
    assert confidence(lines, "d") == [0.0] * 4
    assert confidence(lines, "c") == [1.0] * 3 + [0.5]
    # In a table a joint that is at 0, and not the root, was not seen.
    assert lines[0][3].split(",", 4)[4] == "0.000,0.000,0.000,0.000000,0.000000,0.000000,1.000000,0"


def test_nothing_begins_without_the_root():
    _, _, said = streamed(["Abcd"] * 16)
    assert said == [
        "Not seen in the first 3 s: a. Nothing is filled before the root joint and a bone are"
        " seen.",
        "Nothing was filled: no pose of the stream showed the root joint and a bone.",
    ]


def test_a_joint_that_was_not_seen_at_first_joins():
    _, lines, said = streamed(["abcD"] * 3 + ["abcd"] * 3 + ["abcD"] * 14)
    assert said == []
    assert confidence(lines, "d") == [0.0] * 3 + [1.0] * 3 + [0.5] * 14


def test_help_tells_what_to_send(capsys):
    assert run("denoise", "--help") == 0
    assert "may go out one pose late" in " ".join(capsys.readouterr().out.split())
