"""Setting up: what run.py and test.py do before Markermend is installed."""

from __future__ import annotations

import ast
import importlib.util
import json
import os
import re
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted((ROOT / "packaging").glob("*.py"))


@pytest.fixture
def bootstrap(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Load the module with a project folder of its own."""
    path = ROOT / "packaging" / "bootstrap.py"
    spec = importlib.util.spec_from_file_location("bootstrap_under_test", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    (tmp_path / "pyproject.toml").write_text("[project]\n")
    (tmp_path / "constraints.txt").write_text("numpy==2.0\n")
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "VENV", tmp_path / ".venv")
    monkeypatch.setattr(module, "CONSTRAINTS", tmp_path / "constraints.txt")
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    return module


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda p: p.name)
def test_python_38_can_parse_it(script: Path) -> None:
    ast.parse(script.read_text(encoding="utf-8"), feature_version=(3, 8))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda p: p.name)
def test_it_imports_the_standard_library_only(script: Path) -> None:
    allowed = sys.stdlib_module_names | {p.stem for p in SCRIPTS}
    for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            assert {a.name.split(".")[0] for a in node.names} <= allowed
        elif isinstance(node, ast.ImportFrom):
            assert (node.module or "").split(".")[0] in allowed


def test_constraints_are_names_and_versions_and_cover_every_requirement() -> None:
    lines = (ROOT / "packaging" / "constraints.txt").read_text().splitlines()
    pinned = set()
    for line in lines:
        if not line.startswith("#"):
            assert re.fullmatch(r"[A-Za-z0-9._-]+==[0-9][0-9A-Za-z.]*", line), line
            pinned.add(re.split("==", line)[0].lower().replace("_", "-"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"].values()
    wanted = [*project["dependencies"], *(one for extra in extras for one in extra)]
    names = {re.split(r"[ \[<>=;]", w)[0].lower().replace("_", "-") for w in wanted}
    assert names - {"markermend"} <= pinned


def test_an_old_python_without_a_newer_one_gets_a_sentence(
    bootstrap: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "version_info", (3, 8, 18))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(bootstrap.SetupError, match=r"3\.11 or newer. This is Python 3\.8"):
        bootstrap.find_python()


@pytest.mark.skipif(os.name == "nt", reason="shell scripts stand in for interpreters")
def test_an_old_python_passes_shims_and_takes_one_that_runs(
    bootstrap: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, body in (("python3.12", "exit 127"), ("python3.11", "echo /usr/bin/python3.11")):
        program = tmp_path / name
        program.write_text(f"#!/bin/sh\n{body}\n")
        program.chmod(0o755)
    monkeypatch.setattr(sys, "version_info", (3, 8, 18))
    monkeypatch.setenv("PATH", str(tmp_path))
    assert bootstrap.find_python() == "/usr/bin/python3.11"


class Calls:
    """Stands in for subprocess.call: notes commands, and makes the folder venv would make."""

    def __init__(self, bootstrap: ModuleType, code: int = 0) -> None:
        self.bootstrap, self.code, self.commands = bootstrap, code, []

    def __call__(self, command: list[str], **_: object) -> int:
        self.commands.append(command)
        if "venv" in command:
            python = Path(self.bootstrap.venv_program("python"))
            python.parent.mkdir(parents=True)
            python.touch()
            return 0
        return self.code


@pytest.fixture
def calls(bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch) -> Calls:
    noted = Calls(bootstrap)
    monkeypatch.setattr(bootstrap.subprocess, "call", noted)
    return noted


def test_a_second_run_installs_nothing(bootstrap: ModuleType, calls: Calls) -> None:
    bootstrap.ensure_environment("app")
    assert [("venv" in c, "pip" in c) for c in calls.commands] == [(True, False), (False, True)]
    calls.commands.clear()
    bootstrap.ensure_environment("app")
    assert calls.commands == []


def test_the_tests_need_more_and_the_app_then_nothing(bootstrap: ModuleType, calls: Calls) -> None:
    bootstrap.ensure_environment("app")
    calls.commands.clear()
    bootstrap.ensure_environment("dev")
    assert ["pip" in c for c in calls.commands] == [True]
    calls.commands.clear()
    bootstrap.ensure_environment("app")
    assert calls.commands == []


def test_the_deep_extra_comes_on_top_of_the_tests(bootstrap: ModuleType, calls: Calls) -> None:
    bootstrap.ensure_environment("dev")
    calls.commands.clear()
    bootstrap.ensure_environment("deep")
    assert [c[-1].endswith("[deep]") for c in calls.commands] == [True]
    calls.commands.clear()
    bootstrap.ensure_environment("deep")
    assert calls.commands == []


@pytest.mark.parametrize("name", ["pyproject.toml", "constraints.txt"])
def test_a_change_makes_the_folder_anew(bootstrap: ModuleType, calls: Calls, name: str) -> None:
    bootstrap.ensure_environment("dev")
    leftover = bootstrap.VENV / "leftover"
    leftover.touch()
    (bootstrap.ROOT / name).write_text("changed\n")
    bootstrap.ensure_environment("dev")
    assert not leftover.exists()
    assert sum("venv" in c for c in calls.commands) == 2


def test_a_broken_off_set_up_leaves_no_stamp(bootstrap: ModuleType, calls: Calls) -> None:
    calls.code = 1
    with pytest.raises(bootstrap.SetupError, match="network"):
        bootstrap.ensure_environment("dev")
    assert bootstrap.read_stamp() == ("", set())
    calls.code = 0
    bootstrap.ensure_environment("dev")
    stamp = json.loads((bootstrap.VENV / "markermend-stamp.json").read_text())
    assert stamp["extras"] == ["dev"]


def test_constraints_reach_pip(
    bootstrap: ModuleType, calls: Calls, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = {}

    def call(command: list[str], env: dict[str, str], **_: object) -> int:
        seen.update(env)
        return calls(command)

    monkeypatch.setenv("PYTHONPATH", "/elsewhere")
    monkeypatch.setattr(bootstrap.subprocess, "call", call)
    bootstrap.ensure_environment("dev")
    assert seen["PIP_CONSTRAINT"] == seen["PIP_BUILD_CONSTRAINT"] == str(bootstrap.CONSTRAINTS)
    assert "PYTHONPATH" not in seen


def test_missing_libraries_are_named_with_the_command(
    bootstrap: ModuleType, calls: Calls, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(bootstrap, "missing_libraries", lambda wanted: ["libEGL.so.1"])
    monkeypatch.setattr(bootstrap, "is_debian", lambda: True)
    monkeypatch.setattr(bootstrap.os, "geteuid", lambda: 1000, raising=False)
    with pytest.raises(bootstrap.SetupError) as caught:
        bootstrap.ensure_libraries(display=False)
    assert "sudo apt-get update" in str(caught.value)
    assert "sudo apt-get install -y --no-install-recommends libegl1" in str(caught.value)
    assert calls.commands == []


def test_root_on_debian_installs_them(
    bootstrap: ModuleType, calls: Calls, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(bootstrap, "missing_libraries", lambda wanted: ["libGL.so.1"])
    monkeypatch.setattr(bootstrap, "is_debian", lambda: True)
    monkeypatch.setattr(bootstrap.os, "geteuid", lambda: 0, raising=False)
    bootstrap.ensure_libraries(display=False)
    install = ["apt-get", "install", "-y", "--no-install-recommends", "libgl1"]
    assert calls.commands == [["apt-get", "update"], install]


def test_a_debian_without_venv_is_told_the_package(
    bootstrap: ModuleType, calls: Calls, monkeypatch: pytest.MonkeyPatch
) -> None:
    def ask(command: list[str], **_: object) -> str | None:
        return None if "ensurepip" in command[-1] else "3.11"

    monkeypatch.setattr(bootstrap, "ask", ask)
    monkeypatch.setattr(bootstrap, "is_debian", lambda: True)
    monkeypatch.setattr(bootstrap.os, "geteuid", lambda: 1000, raising=False)
    with pytest.raises(bootstrap.SetupError, match=r"install .* python3\.11-venv"):
        bootstrap.make_venv("/usr/bin/python3.11")
    assert not bootstrap.VENV.exists()
    assert calls.commands == []


def test_other_systems_get_the_names(
    bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bootstrap, "is_debian", lambda: False)
    with pytest.raises(bootstrap.SetupError, match="libgl1"):
        bootstrap.install_packages(["libgl1"], "Missing.")


@pytest.mark.skipif(sys.platform != "linux", reason="asks the Linux loader")
def test_the_loader_is_asked(bootstrap: ModuleType) -> None:
    assert bootstrap.missing_libraries({"libc.so.6": "", "libnone.so.9": ""}) == ["libnone.so.9"]


def test_display_is_decided_from_the_environment(
    bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    assert not bootstrap.display_named()
    monkeypatch.setenv("WAYLAND_DISPLAY", "wayland-0")
    assert bootstrap.display_named()
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    assert not bootstrap.display_named()


def test_a_display_that_does_not_open_is_none(
    bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bootstrap, "venv_program", lambda name: sys.executable)
    monkeypatch.setenv("QT_QPA_PLATFORM", "xcb")
    monkeypatch.setenv("DISPLAY", ":9999")
    assert not bootstrap.display_opens()


@pytest.mark.skipif(os.name == "nt", reason="bash scripts")
def test_ci_calls_the_readme_command() -> None:
    script = ROOT / ".ci" / "run"
    assert os.access(script, os.X_OK)
    assert "python3 packaging/test.py" in script.read_text()
