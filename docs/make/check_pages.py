#!/usr/bin/env python3
"""Checks the pages: links within the repository, spelling, length of sentences and of reports.

Usage: check_pages.py [--list-words] [FOLDER]

Prints one line for each fault, and the mean length of the sentences of each page. Exit status 1 if
there is a fault. --list-words prints the words that neither the dictionary nor docs/spelling.txt has.
Of the pages of FOLDER, which are generated, only the spelling is checked.
"""

import pathlib
import re
import statistics
import subprocess
import sys
import unicodedata

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORDS = ROOT / "docs/spelling.txt"
MOST_WORDS = 20  # in the mean of a page
# Pages whose proofs have sentences that formulas carry.
FORMULAS = {f"docs/explanation/{name}.md" for name in
            ("absence-by-energy", "boxes", "ceiling", "describing-functions", "every-motion",
             "motions", "servo")}

REPORTS = "docs/reference/reports.md"
MOST_LINES = 40  # of a report, as it is shown there

LINK = re.compile(r"(?<!\\)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^)\s]+)\)")


def pages():
    found = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    return found + sorted((ROOT / "docs").rglob("*.md"))


def name_of(page):
    return page.relative_to(ROOT).as_posix()


def without_fences(text):
    """Lines of fenced code become empty, so that numbers of lines stay."""
    lines, fence = [], ""
    for line in text.split("\n"):
        mark = re.match(r"\s*(`{3,}|~{3,})", line)
        if mark and not fence:
            fence = mark.group(1)
        elif mark and fence and line.strip() == fence:
            fence, line = "", ""
        lines.append("" if fence else line)
    return "\n".join(lines)


def without_comments(text):
    """Their line ends stay, so that numbers of lines do."""
    return re.sub(r"<!--.*?-->", lambda comment: "\n" * comment.group().count("\n"), text,
                  flags=re.DOTALL)


def slug(heading):
    """The anchor that code hosts and MyST give a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors_of(page, known={}):
    if page not in known:
        known[page], counts = set(), {}
        for heading in re.findall(r"^#{1,6} +(.*?)\s*$", without_fences(page.read_text()), re.MULTILINE):
            name = slug(heading)
            count = counts.get(name, 0)
            counts[name] = count + 1
            known[page].add(f"{name}-{count}" if count else name)
    return known[page]


def faults_of_links(page):
    text = without_comments(without_fences(page.read_text()))
    for match in LINK.finditer(text):
        target = match.group(2)
        if re.match(r"[a-z]+:", target):
            continue  # tests need no network
        line = text.count("\n", 0, match.start()) + 1
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield f"{name_of(page)}:{line}: link = {target}: no such file"
        elif anchor and file.suffix == ".md" and anchor not in anchors_of(file):
            yield f"{name_of(page)}:{line}: link = {target}: no such heading"


def prose_of(page):
    """The paragraphs, headings and points of lists, without code, tables and comments."""
    text = without_fences(page.read_text())
    text = without_comments(text)
    text = re.sub(r"`[^`]+`", " Code ", text)
    text = re.sub(r"!\[((?:[^\[\]])*)\]\([^)]*\)", "", text)
    text = LINK.sub(r"\1", text)
    return re.sub(r"https?://\S+", " address ", text)


def paragraphs_of(page):
    """The text whose sentences count: no headings, no indented formulas."""
    paragraph = []
    for line in prose_of(page).split("\n") + [""]:
        is_table = line.startswith("|")
        is_formula = re.match(r" {4,}\S", line) and not paragraph
        starts_point = re.match(r"\s*([-*]|\d+\.) ", line)
        if not line.strip() or line.startswith("#") or is_table or is_formula or starts_point:
            if paragraph:
                yield " ".join(paragraph)
            paragraph = []
        if line.strip() and not (line.startswith("#") or is_table or is_formula):
            paragraph.append(re.sub(r"^\s*([-*]|\d+\.) ", "", line).strip())


def sentences_of(page):
    for paragraph in paragraphs_of(page):
        paragraph = re.sub(r"\b(e\.g|i\.e|vs|ch|Fig|no|J|Math|Mech|Soft|Des|Syst|Lett|Int|Res)\.", r"\1", paragraph)
        for sentence in re.split(r"(?<=[.!?])[*)\"”]*\s+(?=[*(\"“]*[A-Z0-9μωζ])", paragraph):
            words = re.findall(r"[\w%°]+(?:[-'’.,/][\w%]+)*", sentence)
            if len(words) > 1:
                yield len(words)


def faults_of_reports():
    """A report that is too long to be read on one screen. Its first line here is the command."""
    shown = re.findall(r"^```text\n\$ (.+)\n((?:.*\n)*?)```$", (ROOT / REPORTS).read_text(), re.MULTILINE)
    if not shown:
        yield f"{REPORTS}: shows no report"
    for command, report in shown:
        lines = report.count("\n")
        if lines > MOST_LINES:
            yield f"{REPORTS}: {command}: {lines} lines: must be at most {MOST_LINES}"


def is_word(text):
    """Whether it is none of the symbols and units that formulas leave in the text, nor a name of code
    (TuneTask)."""
    return len(text) > 3 and not re.search("[a-z][A-Z]", text) and all(
        unicodedata.name(letter, "").startswith("LATIN") or letter == "'" for letter in text)


def unknown_words(page):
    listed = set()
    if WORDS.exists():
        listed = {line for line in WORDS.read_text().split("\n") if not line.startswith("#")}
    text = re.sub(r"^ {4,}\S.*", "", prose_of(page), flags=re.MULTILINE)
    text = re.sub(r"[_\d]", " ", text.replace("’", "'"))
    run = subprocess.run(["hunspell", "-d", "en_US", "-i", "utf-8", "-l"], input=text,
                         capture_output=True, text=True, check=True)
    words = {word.strip("'").removesuffix("'s") for word in run.stdout.split()}
    return {word for word in words if is_word(word) and not listed & {word, word.lower()}}


def faults_of_spelling(page, words):
    unknown = sorted(unknown_words(page))
    words.update(unknown)
    return [f"{name_of(page)}: word = {word}: not in the dictionary" for word in unknown]


def main():
    faults = list(faults_of_reports())
    words = set()
    for folder in sys.argv[1:]:
        if folder.startswith("--"):
            continue
        for page in sorted(pathlib.Path(folder).resolve().rglob("*.md")):
            faults += faults_of_spelling(page, words)
    for page in pages():
        name = name_of(page)
        faults += faults_of_links(page)
        faults += faults_of_spelling(page, words)
        lengths = list(sentences_of(page))
        if not lengths or name in FORMULAS:
            continue
        mean = statistics.fmean(lengths)
        if "--list-words" not in sys.argv:
            print(f"{mean:5.1f} words in the mean of {len(lengths):4d} sentences  {name}")
        if mean > MOST_WORDS:
            faults.append(f"{name}: mean sentence = {mean:.1f} words: must be at most {MOST_WORDS}")
    if "--list-words" in sys.argv:
        print("\n".join(sorted(words)))
        return
    print("\n".join(faults), file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
