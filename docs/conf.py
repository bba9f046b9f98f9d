"""Settings of Sphinx for `make docs`, which runs it over a copy of docs in build/docs/source."""

import re
from pathlib import Path

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Generic, Text

BUILT = Path(__file__).resolve().parents[2]  # build/docs

project = "Gearlash"
author = "The authors of Gearlash"
copyright = author
cmake = (BUILT / "source/CMakeLists.txt").read_text()
version = release = re.search(r"VERSION ([0-9.]+)\n", cmake).group(1)

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
exclude_patterns = ["schemas"]

myst_heading_anchors = 4
myst_enable_extensions = []

breathe_projects = {"gearlash": str(BUILT / "doxygen/xml")}
breathe_default_project = "gearlash"
breathe_default_members = ("members",)
highlight_language = "text"

autodoc_typehints = "none"  # docstrings have the types
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False

html_theme = "furo"
html_static_path = ["static", str(BUILT / "theme")]
html_css_files = ["pages.css"]
html_title = f"Gearlash {release}"
html_show_sourcelink = False
html_copy_source = False


class Shown(RegexLexer):
    """What a terminal shows: commands after "$ ", and their output."""

    name = "text"
    tokens = {"root": [(r"^(\$ )(.*\n)", bygroups(Generic.Prompt, Generic.Strong)), (r".*\n", Text)]}


def as_text(app, env, node, text):
    """The text of a link to something in the repository that is neither a page nor a file to load."""
    target = (BUILT / "source/docs" / node["refdoc"]).parent / node["reftarget"]
    return text if target.exists() else None


def setup(app):
    app.add_lexer("text", Shown)
    app.connect("missing-reference", as_text)
