"""Settings of Sphinx for `make docs`, which runs it over a copy of docs in build/docs/source."""

import re
from pathlib import Path

from docutils import nodes
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


GENERATED = {"Verbs": "verbs", "Parameters": "parameters", "Quantities": "quantities",
             "JSON": "json/index", "C++": "cpp/index", "Python": "python"}


def link_generated(app, page, source):
    """The repository lacks the generated pages, so that its pages name them in italics."""
    if re.fullmatch("reference/[^/]+", page):
        for name, target in GENERATED.items():
            italics = rf"(?<!\*)\*{re.escape(name)}\*(?!\*)"
            source[0] = re.sub(italics, f"[{name}](generated/{target}.md)", source[0])


def escape_underscores(app, what, name, thing, options, lines):
    """A member such as `yield_` is no reference."""
    lines[:] = [re.sub(r"^:(\w+) (\w+)_:", r":\1 \2\\_:", line) for line in lines]


def drop_empty_dashes(app, doctree):
    """A parameter without a description needs no dash after its type."""
    for field in doctree.findall(nodes.field):
        for paragraph in field.findall(nodes.paragraph):
            while paragraph.children and paragraph[-1].astext() in ("", " -- ", " – "):
                paragraph.pop()


def as_text(app, env, node, text):
    """The text of a link to something in the repository that is neither a page nor a file to load."""
    target = (BUILT / "source/docs" / node["refdoc"]).parent / node["reftarget"]
    return text if target.exists() else None


def setup(app):
    app.add_lexer("text", Shown)
    app.connect("source-read", link_generated)
    app.connect("autodoc-process-docstring", escape_underscores, priority=900)  # after napoleon
    app.connect("doctree-read", drop_empty_dashes)
    app.connect("missing-reference", as_text)
