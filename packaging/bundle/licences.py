"""Collect the licences of everything a bundle holds: ``python licences.py FOLDER``."""

import shutil
import sys
import sysconfig
from importlib.metadata import distributions
from pathlib import Path

BUILDERS = {"pip", "setuptools", "pyinstaller", "pyinstaller-hooks-contrib", "altgraph", "pillow"}


def main():
    """Write one folder a package with its licence files, and a list of them all."""
    target = Path(sys.argv[1])
    shutil.rmtree(str(target), ignore_errors=True)
    target.mkdir(parents=True)
    lines = []
    found = sorted(distributions(), key=lambda d: d.metadata["Name"].lower())
    for package in (d for d in found if d.metadata["Name"].lower() not in BUILDERS):
        name = "%s-%s" % (package.metadata["Name"], package.version)
        lines.append("%-40s %s" % (name, licence_of(package)))
        for file in package.files or ():
            if any(word in file.name.upper() for word in ("LICEN", "COPYING", "NOTICE", "AUTHORS")):
                source = Path(str(package.locate_file(file)))
                if source.is_file() and source.suffix not in (".py", ".pyc"):
                    (target / name).mkdir(exist_ok=True)
                    shutil.copy(str(source), str(target / name / source.name))
    python = Path(sysconfig.get_path("stdlib")) / "LICENSE.txt"
    if python.is_file():
        shutil.copy(str(python), str(target / "Python-LICENSE.txt"))
    lines.append("%-40s PSF-2.0" % ("Python-%d.%d.%d" % sys.version_info[:3]))
    (target / "licences.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def licence_of(package):
    """Name of a package's licence, as its metadata states it."""
    meta = package.metadata
    stated = meta.get("License-Expression") or meta.get("License") or ""
    if stated and "\n" not in stated:
        return stated
    kinds = [c.split(" :: ")[-1] for c in meta.get_all("Classifier", []) if "License ::" in c]
    return ", ".join(kinds) or "see its files"


if __name__ == "__main__":
    main()
