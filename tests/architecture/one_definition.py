#!/usr/bin/env python3
"""Checks the one-definition rule where no linker does.

Two .cpp files that each define a class, or an inline function or template, of one name in one
namespace make a program that is undefined: the linker keeps either. So what a .cpp file of the
product defines for itself stands in an anonymous namespace, and what it defines of the name of a
namespace must stand in no other file.

Usage: one_definition.py ROOT       prints every name defined in several files; exit status 1 if any
"""

import pathlib
import re
import sys

TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<delimiter>[^(\s]*)\(.*?\)(?P=delimiter)"'
    r"|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*",
    re.DOTALL | re.MULTILINE)
NAMESPACE = re.compile(r"(?:inline\s+)?namespace\s*([\w:]*)\s*$")
TYPE = re.compile(r"\b(?:struct|class|union|enum)\s+(?:class\s+|struct\s+)?(?:\[\[[^]]*\]\]\s*)?"
                  r"([\w:]+)\s*(?:final\s*)?(?::[^:].*)?$", re.DOTALL)
FUNCTION = re.compile(r"\b(?:inline|constexpr|template)\b.*?([\w:]+)\s*\(", re.DOTALL)


def without_comments_and_texts(text):
    return TOKEN.sub(lambda match: " " + "\n" * match[0].count("\n"), text)


def definitions(text):
    """(qualified name, line) of each class, and of each inline function or template, that a
    namespace with a name holds."""
    text = re.sub(r"'(?=\d)", "", text)  # 1'000
    text = without_comments_and_texts(text)
    scopes = []  # the name of a namespace, "" of an anonymous one, None of any other braces
    begin = 0
    for match in re.finditer(r"[{};]", text):
        head = text[begin : match.start()].strip()
        begin = match.end()
        if match[0] == "}":
            if scopes:
                scopes.pop()
        elif match[0] == "{":
            namespace = NAMESPACE.search(head)
            at_namespace = all(scope for scope in scopes)
            name = None
            if namespace is None and at_namespace:
                found = TYPE.search(head) or FUNCTION.search(head)
                name = found and found[1]
            if name and "::" not in name and not re.search(r"template\s*<\s*>", head):
                line = text.count("\n", 0, match.start()) + 1
                yield "::".join([*scopes, name]), line
            scopes.append(namespace[1] if namespace else None)


def faults(root):
    """Names that several files define. Overloads in one file, or headers', are the compiler's."""
    places = {}
    for folder in ("include", "src", "apps"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for name, line in definitions(path.read_text(encoding="utf-8")):
                places.setdefault(name, []).append((path.relative_to(root), line))
    for name, where in sorted(places.items()):
        files = {path for path, _ in where}
        if len(files) > 1 and any(path.suffix == ".cpp" for path in files):
            others = ", ".join(f"{path}:{line}" for path, line in where[1:])
            yield f"{where[0][0]}:{where[0][1]}: {name} is defined in {others} too"


def main():
    found = list(faults(pathlib.Path(sys.argv[1])))
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
