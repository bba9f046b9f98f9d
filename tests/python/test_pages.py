"""The Python of the pages is run, block by block, beside examples/ and the sweeps that pages make."""

import doctest
import re

import pytest

from conftest import ROOT

PAGES = [page for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
         if ">>> " in page.read_text("utf-8")]


@pytest.mark.filterwarnings("ignore::DeprecationWarning:tornado", "ignore:make_current")
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_shows_what_python_prints_now(page, monkeypatch, tmp_path, tool):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    # A fence ends a block of output.
    text = page.read_text("utf-8").replace("```", "\n")
    sweeps = re.findall("^gearlash (sweep examples/.*)$", text, re.MULTILINE)
    if not sweeps and 'dataset("sweep.nc")' in text:
        sweeps = ["sweep examples/sweep.toml --output sweep.nc"]
    for arguments in sweeps:
        tool(*arguments.split())
    parser = doctest.DocTestParser()
    test = parser.get_doctest(text, {}, page.name, str(page), 0)
    failures = []
    runner = doctest.DocTestRunner(verbose=False)
    runner.run(test, out=failures.append)
    assert test.examples and not failures, "".join(failures)
