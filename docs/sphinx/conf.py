"""How Sphinx builds the manual as web pages; packaging/manual.py lays its sources out."""

import markermend

project = "Markermend"
author = copyright = "Markermend"
version = release = markermend.__version__
extensions = [
    *("myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinx.ext.napoleon"),
    "sphinx.ext.viewcode",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
html_theme = "furo"
html_title = f"Markermend {version}"
html_logo = "markermend.svg"
html_copy_source = False
autodoc_typehints = "description"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
myst_heading_anchors = 3
# Cross references from docstrings to private helpers and to other libraries are not links here.
nitpicky = False
suppress_warnings = ["ref.python", "docutils"]
