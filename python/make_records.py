#!/usr/bin/python3
"""Makes the Python records of the public C++ structs, so that the two cannot differ.

Reads the headers of include/gearlash, which are written in one style, and writes

  _records.py   a frozen dataclass for each struct, with its members, defaults and comments
  records.hpp   for each struct the list of its members, and for each enumeration its words

make_records.py _RECORDS.PY RECORDS.HPP HEADER...    (a header after those that it needs)
"""

import keyword
import re
import sys
import textwrap
from dataclasses import dataclass, field
from pathlib import Path

# Spans of memory, classes with behaviour of their own, and what the module gives as arrays.
LEFT_OUT = {"DriveList", "Grid", "MotionEvent", "MotionSample", "Samples", "Shafts", "Span"}


@dataclass
class Member:
    name: str
    type: str
    default: str
    comment: str


@dataclass
class Struct:
    name: str
    comment: str
    members: list[Member] = field(default_factory=list)


@dataclass
class Enumeration:
    name: str
    members: list[str]
    words: list[str]  # what name_of() gives


@dataclass
class Source:
    """What the headers declare."""

    structs: list[Struct] = field(default_factory=list)
    enumerations: dict[str, Enumeration] = field(default_factory=dict)
    variants: dict[str, list[str]] = field(default_factory=dict)
    named: set[str] = field(default_factory=set)  # enumerations with name_of()


def python_name(member: Member) -> str:
    return f"{member.name}_" if keyword.iskeyword(member.name) else member.name


def comment_of(lines: list[str]) -> str:
    return " ".join(line.strip().lstrip("/").lstrip("<").strip() for line in lines).strip()


def join_declarations(body: str) -> list[tuple[str, str]]:
    """Declarations of a struct's body, each with its comment."""
    found: list[tuple[str, str]] = []
    above: list[str] = []
    pending = ""
    depth = 0
    for line in body.splitlines():
        code, mark, note = line.partition("///")
        code, _, _ = code.partition("//")
        code = code.strip()
        if mark and note.startswith("<"):
            if code:
                pending = f"{pending} {code}".strip()
                above.append(note)
            elif found and not pending:
                found[-1] = (found[-1][0], f"{found[-1][1]} {comment_of([note])}".strip())
            else:
                above.append(note)
        elif mark and not code:
            if not pending and not depth:
                above.append(note)
        else:
            pending = f"{pending} {code}".strip()
        depth = pending.count("{") - pending.count("}")
        if depth == 0 and pending.endswith((";", "}")):
            found.append((pending.rstrip(";").strip(), comment_of(above)))
            pending, above = "", []
        elif not code and not mark:
            above = []
    return found


def members_of(declaration: str, comment: str) -> list[Member]:
    """The members that one declaration declares; none for a function or a constant."""
    if declaration.startswith(("static", "[[nodiscard]]", "bool operator", "Target&", "auto")):
        return []
    head = declaration.split("=")[0].split("{")[0]
    if "(" in head:
        return []
    match = re.match(r"((?:std::)?[\w:]+(?:<.*>)?)\s+(\w+\s*(?:[={,].*)?)$", declaration)
    if match is None:
        raise SystemExit(f"make_records: cannot read the declaration: {declaration}")
    type_name, rest = match.groups()
    members = []
    for part in split(rest):
        name, _, default = part.partition("=")
        if "{" in name:
            name, default = name.split("{")[0], ""
        members.append(Member(name.strip(), type_name, default.strip(), comment))
    return members


def split(text: str) -> list[str]:
    """Splits at commas outside brackets."""
    parts, depth, part = [], 0, ""
    for character in text:
        depth += character in "({<["
        depth -= character in ")}>]"
        if character == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += character
    return parts + [part]


def read(header: str, source: Source) -> None:
    above = r"((?:^///[^\n]*\n)*)"
    for match in re.finditer(rf"{above}^struct (\w+) {{\n(.*?)^}};", header, re.M | re.S):
        comment, name, body = match.groups()
        if name in LEFT_OUT:
            continue
        struct = Struct(name, comment_of(comment.splitlines()))
        for declaration, note in join_declarations(body):
            struct.members += members_of(declaration, note)
        source.structs.append(struct)
    for match in re.finditer(r"^enum class (\w+)[^{]*\{([^}]*)\};", header, re.M):
        name, body = match.groups()
        members = re.findall(r"\w+", re.sub("//.*", "", body))
        source.enumerations[name] = Enumeration(name, members, list(members))
    for name, kinds in re.findall(r"^using (\w+) = std::variant<([^>]*)>;", header, re.M):
        source.variants[name] = [kind.strip() for kind in kinds.split(",")]
    for above, name in re.findall(rf"{above}[^\n]*name_of\((\w+) ", header, re.M):
        source.named.add(name)
        if enumeration := source.enumerations.get(name):
            enumeration.words = words_by(comment_of(above.splitlines()), enumeration.members)


def words_by(comment: str, members: list[str]) -> list[str]:
    """The words of an enumeration by the comment on its name_of()."""
    quoted = re.findall('"([^"]+)"', comment)
    if len(quoted) == len(members):
        return quoted
    return [name.replace("_", " ") if "with spaces" in comment else name for name in members]


# ---- Python ---------------------------------------------------------------------------------------

SIMPLE = {"double": "float", "bool": "bool", "int": "int", "std::size_t": "int",
          "std::uint64_t": "int", "std::string": "str", "std::string_view": "str", "Drive": "Drive"}


def python_type(name: str, source: Source) -> str:
    if inner := re.fullmatch(r"std::(optional|vector)<(.*)>", name):
        of = python_type(inner[2], source)
        return f"{of} | None" if inner[1] == "optional" else f"tuple[{of}, ...]"
    return SIMPLE.get(name, name)


def python_default(member: Member, source: Source) -> str:
    kind, default = member.type, member.default
    if not default or default == "{}":
        if kind.startswith("std::optional"):
            return "None"
        if kind.startswith("std::vector"):
            return "()"
        if kind in source.variants:
            return f"_field(default_factory={source.variants[kind][0]})"
        if kind == "Drive":
            return "_field(default_factory=Drive._empty)"
        if kind in source.enumerations:
            return repr(source.enumerations[kind].words[0])
        empty = {"std::string": '""', "std::string_view": '""', "double": "0.0"}
        return empty.get(kind) or f"_field(default_factory={kind})"
    if "quiet_NaN" in default:
        return "None"
    if found := re.fullmatch(r"(\w+)::(\w+)", default):
        enumeration = source.enumerations[found[1]]
        return repr(enumeration.words[enumeration.members.index(found[2])])
    if found := re.fullmatch(r"{(.*)}", default):
        return f"({found[1]},)"
    if found := re.fullmatch(r"std::size_t{(\d+)} << (\d+)U", default):
        return str(int(found[1]) << int(found[2]))
    return {"true": "True", "false": "False"}.get(default, default.replace("'", "_"))


def annotation(member: Member, source: Source) -> str:
    of = python_type(member.type, source)
    return f"{of} | None" if of == "float" and "NaN" in member.comment + member.default else of


def python_of(comment: str) -> str:
    """A comment with Python's words for those of C++."""
    for cpp, python in (("Answer::", "Answer."), ("::", "."), ("NaN", "None"), ("nullptr", "None"),
                        ("\\", "\\\\"), ("|", "\\\\|")):  # of reStructuredText
        comment = comment.replace(cpp, python)
    return comment


def class_text(struct: Struct, source: Source, extra: list[str]) -> str:
    wrapped = textwrap.fill(python_of(struct.comment) or f"See its members.", 92,
                            initial_indent='    """', subsequent_indent="    ")
    base = struct.name if struct.name in extra else "Record"
    lines = ["@_dataclass(frozen=True)", f"class {struct.name}(_methods.{base}):", wrapped, ""]
    if struct.members:
        lines += ["    Attributes", "    ----------"]
    for member in struct.members:
        lines.append(f"    {python_name(member)} : {annotation(member, source)}")
        if member.comment:
            lines.append(textwrap.fill(python_of(member.comment), 92, initial_indent=" " * 8,
                                       subsequent_indent=" " * 8))
    if struct.name == "Answer":
        lines += ["    drive : Drive | None", "        the drive that was analysed"]
    lines += ['    """', ""]
    declared = [(python_name(member), annotation(member, source), python_default(member, source))
                for member in struct.members]
    if struct.name == "Answer":
        declared.append(("drive", "Drive | None", "None"))
    lines += [f"    {name}: {of} = {default}" for name, of, default in declared]
    sequences = [name for name, of, _ in declared if of.startswith("tuple[")]
    if sequences:  # any sequence may be given, and is kept as a tuple
        given = ", ".join(
            f"{name}: Iterable[{of[len('tuple['):-len(', ...]')]}] = ..." if name in sequences
            else f"{name}: {of} = ..." for name, of, _ in declared)
        lines += ["", f"    _sequences = {tuple(sequences)!r}", "", "    if TYPE_CHECKING:",
                  f"        def __init__(self, {given}) -> None: ..."]
    return "\n".join(lines) + "\n\n\n"


def python_text(source: Source, extra: list[str]) -> str:
    text = ('"""The records of the C++ library, made by python/make_records.py."""\n\n'
            "from __future__ import annotations\n\n"
            "from collections.abc import Iterable\n"
            "from dataclasses import dataclass as _dataclass\n"
            "from dataclasses import field as _field\n"
            "from typing import TYPE_CHECKING, Literal, Union\n\n"
            "from gearlash import _methods\n"
            "from gearlash._drive import Drive\n\n")
    for name, enumeration in source.enumerations.items():
        words = "".join(f"    {word!r},\n" for word in enumeration.words)
        text += f"{name} = Literal[\n{words}]\n"
    for name, kinds in source.variants.items():
        text += f"{name} = Union[{', '.join(repr(kind) for kind in kinds)}]\n"
    text += "\n\n" + "".join(class_text(struct, source, extra) for struct in source.structs)
    names = [struct.name for struct in source.structs]
    listed = "".join(f"    {name!r},\n" for name in sorted(names))
    return text + f"__all__ = [\n{listed}]\n"


# ---- C++ ------------------------------------------------------------------------------------------


def cpp_text(source: Source, headers: list[Path]) -> str:
    text = "// The members of the public structs, made by python/make_records.py.\n#pragma once\n\n"
    text += "".join(f'#include "gearlash/{header.name}"\n' for header in headers)
    text += '#include "record.hpp"\n\nnamespace gearlash::python {\n\n'
    for name, enumeration in source.enumerations.items():
        words = ", ".join(f'{{{name}::{word}, "{word}"}}' for word in enumeration.members)
        if name in source.named:
            words = ", ".join(f"{{{name}::{word}, nullptr}}" for word in enumeration.members)
        text += (f"template <>\nstruct Words<{name}> {{\n"
                 f'  static constexpr const char* name = "{name}";\n'
                 f"  static constexpr Word<{name}> all[] = {{{words}}};\n"
                 f"  static std::string named({name} value) {{\n"
                 + (f"    return std::string(name_of(value));\n" if name in source.named else
                    "    return all[static_cast<std::size_t>(value)].text;\n")
                 + "  }\n};\n\n")
    for struct in source.structs:
        fields = ",\n".join(f'      Member{{"{python_name(member)}", &{struct.name}::{member.name}}}'
                            for member in struct.members)
        text += (f"template <>\nstruct Record<{struct.name}> {{\n"
                 f'  static constexpr const char* name = "{struct.name}";\n'
                 f"  static constexpr auto members = std::make_tuple(\n{fields});\n}};\n\n")
    text += "template <class Visit>\nvoid for_each_record(Visit visit) {\n"
    text += "".join(f"  visit(static_cast<const {struct.name}*>(nullptr));\n"
                    for struct in source.structs)
    text += "}\n\ntemplate <class Visit>\nvoid for_each_enumeration(Visit visit) {\n"
    text += "".join(f"  visit(static_cast<const {name}*>(nullptr));\n"
                    for name in source.enumerations)
    return text + "}\n\n}  // namespace gearlash::python\n"


def main() -> None:
    python, cpp, *headers = map(Path, sys.argv[1:])
    source = Source()
    for header in headers:
        read(header.read_text(encoding="utf-8"), source)
    methods = (Path(__file__).parent / "gearlash" / "_methods.py").read_text(encoding="utf-8")
    extra = re.findall(r"^class (\w+)", methods, re.M)
    for path, text in ((python, python_text(source, extra)), (cpp, cpp_text(source, headers))):
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
