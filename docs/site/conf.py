"""The documentation as a site: docs/site/build.sh builds it.

RIMLINE_SITE_XML is the folder of Doxygen's XML. The Python package must be importable.
"""

import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]

project = "Rimline"
author = "The Rimline authors"
copyright = "2026, The Rimline authors"
release = re.search(r"project\(Rimline VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "sphinx.ext.autodoc", "breathe"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = []
root_doc = "index"
html_theme = "furo"
html_title = f"Rimline {release}"
html_copy_source = False
html_show_sphinx = False

# Links to sections, as on the pages of the repository.
myst_heading_anchors = 3

autodoc_mock_imports = ["vtkmodules"]
autodoc_member_order = "bysource"
breathe_projects = {"rimline": os.environ["RIMLINE_SITE_XML"]}
breathe_default_project = "rimline"
breathe_default_members = ("members",)
breathe_domain_by_file_pattern = {"*/tools/c/*": "c"}
highlight_language = "none"


def without_readme(app, name, source):
    """README.md is the repository's first page, and not of the site: its links become text."""
    source[0] = re.sub(r"\[([^\]]*)\]\((?:\.\./)+README\.md[^)]*\)", r"\1", source[0])


def setup(app):
    app.connect("source-read", without_readme)
