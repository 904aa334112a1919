"""Build the manual as web pages: ``python3 packaging/manual.py``; leaves ``build/manual``.

The pages are those that the window shows, with the reference of the command line, of the methods
and of the library, and the gallery of scripts. What Sphinx warns of is an error.
"""

import os
import shutil
import subprocess
import sys

import bootstrap

ROOT = bootstrap.ROOT
ENVIRONMENT, SOURCES = ROOT / "build" / "manual-venv", ROOT / "build" / "manual-sources"
TARGET = ROOT / "build" / "manual"
TOOLS = ("sphinx>=8", "myst-parser>=4", "furo>=2024.8")
PAGES = ROOT / "resources" / "markermend_resources" / "manual"


def main():
    """Lay the sources out and build; returns an exit code."""
    python = make_environment()
    lay_out()
    shutil.rmtree(str(TARGET), ignore_errors=True)
    command = [python, "-m", "sphinx", "-b", "html", "-q", "-W", "--keep-going"]
    code = subprocess.call([*command, str(SOURCES), str(TARGET)], env=bootstrap.child_environment())
    if code == 0:
        bootstrap.say("The manual: %s" % (TARGET / "index.html"))
    return code


def make_environment():
    """Make an environment with Markermend and Sphinx; returns its Python."""
    folder = ENVIRONMENT / ("Scripts" if os.name == "nt" else "bin")
    python = str(folder / ("python.exe" if os.name == "nt" else "python"))
    env = bootstrap.child_environment()
    if not os.path.exists(python):
        subprocess.check_call([bootstrap.find_python(), "-m", "venv", str(ENVIRONMENT)], env=env)
    install = [python, "-m", "pip", "install", "--quiet", "--prefer-binary"]
    subprocess.check_call([*install, *TOOLS, "--editable", str(ROOT)], env=env)
    return python


def lay_out():
    """Put all pages into one folder, with a contents list that Sphinx understands."""
    shutil.rmtree(str(SOURCES), ignore_errors=True)
    shutil.copytree(str(PAGES), str(SOURCES))
    icon = PAGES.parent / "icons" / "markermend.svg"
    for path in (*(ROOT / "docs" / "sphinx").iterdir(), icon):
        if path.is_file():
            shutil.copy(str(path), str(SOURCES))
    template = (ROOT / "docs" / "plugin-template" / "README.md").read_text(encoding="utf-8")
    (SOURCES / "plugin-template.md").write_text(template, encoding="utf-8")
    (SOURCES / "gallery.md").write_text(gallery(), encoding="utf-8")
    front = SOURCES / "index.md"
    pages = sorted(p.stem for p in PAGES.glob("*.md") if p.name != "index.md")
    more = ["api", "gallery", "plugin-template"]
    tree = "\n".join(["", "```{toctree}", ":hidden:", *in_order(front, pages), *more, "```", ""])
    links = "".join("- [%s](%s.md)\n" % (title_of(name), name) for name in more)
    front.write_text(front.read_text(encoding="utf-8") + links + tree, encoding="utf-8")


def in_order(front, pages):
    """Pages in the order in which the front page names them."""
    text = front.read_text(encoding="utf-8")
    return sorted(pages, key=lambda page: text.find("(%s.md)" % page))


def title_of(name):
    """First heading of a page."""
    return (SOURCES / (name + ".md")).read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ")


def gallery():
    """Every script of the gallery on one page."""
    parts = ["# Gallery\n\nShort scripts to start from.\n"]
    for path in sorted((ROOT / "docs" / "gallery").glob("*.py")):
        code = path.read_text(encoding="utf-8")
        parts.append("## %s\n\n```python\n%s```\n" % (path.stem.replace("_", " "), code))
    return "\n".join(parts)


if __name__ == "__main__":
    sys.exit(bootstrap.run_main(main))
