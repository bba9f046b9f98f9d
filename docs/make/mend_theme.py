#!/usr/bin/env python3
"""Mends the files of Debian's Furo that work only behind a web server, or were badly compiled.

Usage: mend_theme.py FOLDER

FOLDER receives the files that replace those of the theme.
"""

import pathlib
import re
import sys

import furo

NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")


def script(theme):
    """One script: a browser imports no other from a file."""
    spy = (theme / "scripts/gumshoe-patched.js").read_text()
    own = (theme / "scripts/furo.js").read_text()
    return spy + re.sub(r"^import Gumshoe .*\n", "", own, flags=re.MULTILINE)


def style(theme):
    """Its base by a relative address, and the dark colours also for who has set them in the browser."""
    css = (theme / "styles/furo.css").read_text().replace("/javascript/normalize.css/", "")
    if "prefers-color-scheme" not in css:
        dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*\})', css).group(1)
        css += f'\n@media screen and (prefers-color-scheme: dark) {{\n  body[data-theme="auto"] {dark}\n}}\n'
    return css


def main():
    folder = pathlib.Path(sys.argv[1])
    theme = pathlib.Path(furo.__file__).parent / "theme/furo/static"
    for name, text in (("scripts/furo.js", script(theme)), ("styles/furo.css", style(theme)),
                       ("styles/normalize.css", NORMALIZE.read_text())):
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


if __name__ == "__main__":
    main()
