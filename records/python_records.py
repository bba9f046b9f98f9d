"""Python's records: a frozen dataclass for each public struct, with members, defaults, comments."""

import keyword
import re
import textwrap

from headers import Member, Source, Struct

# Spans of memory, classes with behaviour of their own, and what the module gives as arrays.
LEFT_OUT = {"Colour", "ComparedDrive", "ComparisonOptions", "DriveList", "Grid", "MachineRun",
            "MotionEvent", "MotionSample", "NamedDrive", "Samples", "Shafts", "Span"}


def python_name(member: Member) -> str:
    return f"{member.name}_" if keyword.iskeyword(member.name) else member.name


SIMPLE = {"double": "float", "bool": "bool", "int": "int", "std::size_t": "int",
          "std::uint64_t": "int", "std::string": "str", "std::string_view": "str", "Drive": "Drive",
          "MapCurve": "tuple[tuple[float, float], ...]"}


def python_type(name: str, source: Source) -> str:
    if pair := re.fullmatch(r"std::vector<std::pair<std::string_view, (.*)>>", name):
        return f"dict[str, {python_type(pair[1], source)}]"
    if inner := re.fullmatch(r"std::(optional|vector)<(.*)>", name):
        of = python_type(inner[2], source)
        return f"{of} | None" if inner[1] == "optional" else f"tuple[{of}, ...]"
    if name in source.aliases and name not in SIMPLE:
        return python_type(source.aliases[name], source)
    return SIMPLE.get(name, name)


def python_default(member: Member, source: Source) -> str:
    kind, default = member.type, member.default
    if not default or default == "{}":
        if kind.startswith("std::optional"):
            return "None"
        if kind.startswith("std::vector"):
            return "()"
        if kind in source.variants:
            return f"_field(default_factory={source.variants[kind].kinds[0]})"
        if kind == "Drive":
            return "_field(default_factory=Drive._empty)"
        if kind in source.enumerations:
            return repr(source.enumerations[kind].words[0])
        empty = {"std::string": '""', "std::string_view": '""', "double": "0.0", "MapCurve": "()"}
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
    members = struct.members
    if members:
        lines += ["    Attributes", "    ----------"]
    for member in members:
        lines.append(f"    {python_name(member)} : {annotation(member, source)}")
        if member.comment:
            lines.append(textwrap.fill(python_of(member.comment), 92, initial_indent=" " * 8,
                                       subsequent_indent=" " * 8))
    if struct.name == "Answer":
        lines += ["    drive : Drive | None", "        the drive that was analysed"]
    lines += ['    """', ""]
    declared = [(python_name(member), annotation(member, source), python_default(member, source))
                for member in members]
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
    for member in struct.all_members:
        if member.is_computed:
            of = python_type(member.type, source)
            lines += ["", "    @property", f"    def {member.name}(self) -> {of}:",
                      f'        """{python_of(member.comment)}"""',
                      f'        value: {of} = _core.computed(self, "{member.name}")',
                      "        return value"]
    return "\n".join(lines) + "\n\n\n"


def python_text(source: Source, extra: list[str]) -> str:
    """`extra`: the records that have methods of their own."""
    text = ('"""The records of the C++ library, made by records/make."""\n\n'
            "from __future__ import annotations\n\n"
            "from collections.abc import Iterable\n"
            "from dataclasses import dataclass as _dataclass\n"
            "from dataclasses import field as _field\n"
            "from typing import TYPE_CHECKING, Literal, Union\n\n"
            "from gearlash import _core, _methods\n"
            "from gearlash._drive import Drive\n\n")
    for name, enumeration in source.enumerations.items():
        words = "".join(f"    {word!r},\n" for word in enumeration.words)
        text += f"{name} = Literal[\n{words}]\n"
    for name, variant in source.variants.items():
        text += f"{name} = Union[{', '.join(repr(kind) for kind in variant.kinds)}]\n"
    structs = [struct for name, struct in source.structs.items() if name not in LEFT_OUT]
    text += "\n\n" + "".join(class_text(struct, source, extra) for struct in structs)
    names = [struct.name for struct in structs]
    listed = "".join(f"    {name!r},\n" for name in sorted(names))
    return text + f"__all__ = [\n{listed}]\n"
