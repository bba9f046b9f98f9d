"""Members for C++: for each struct the list of them, and for each enumeration its words."""

import keyword
from pathlib import Path

from headers import Enumeration, Member, Source, Struct
from python_records import python_name

LEFT_OUT = {"DriveList"}  # it holds spans of memory that is not its own


def qualified(of) -> str:
    return f"{of.namespace}::{of.name}"


def words_text(enumeration: Enumeration) -> str:
    name = qualified(enumeration)
    words = ", ".join(f'{{{name}::{word}, "{word}"}}' for word in enumeration.members)
    named = "std::string(name_of(value))" if enumeration.is_named else \
        "all[static_cast<std::size_t>(value)].text"
    return (f"template <>\nstruct Words<{name}> {{\n"
            f'  static constexpr const char* name = "{enumeration.name}";\n'
            f"  static constexpr Word<{name}> all[] = {{{words}}};\n"
            f"  static std::string named({name} value) {{ return {named}; }}\n}};\n\n")


def other(member: Member) -> str:
    """Its unit, and Python's name where that is another one."""
    unit = f', "{member.unit}"' if member.unit or keyword.iskeyword(member.name) else ""
    return unit + (f', "{python_name(member)}"' if keyword.iskeyword(member.name) else "")


def record_text(struct: Struct) -> str:
    name = qualified(struct)

    def listed(members) -> str:
        return ",\n".join(f'      {"Opened" if member.is_opened(struct) else "Member"}'
                          f'{{"{member.name}", &{name}::{member.name}{other(member)}}}'
                          for member in members)

    members = struct.all_members
    held = [member for member in members if not member.is_computed]
    computed = [member for member in members if member.is_computed]
    document = f'  static constexpr const char* document = "{struct.document}";\n' \
        if struct.document else ""
    return (f"template <>\nstruct Record<{name}> {{\n"
            f'  static constexpr const char* name = "{struct.name}";\n{document}'
            f"  static constexpr auto members = std::make_tuple(\n{listed(held)});\n"
            f"  static constexpr auto computed = std::make_tuple({listed(computed).lstrip()});\n"
            "};\n\n")


def include_of(header: Path) -> str:
    """As the sources write it: "gearlash/answer.hpp", "output/tune_report.hpp"."""
    for folder in ("include", "src"):
        if folder in header.parts:
            return "/".join(header.parts[header.parts.index(folder) + 1:])
    return header.name


def members_text(own: Source, includes: list[Path], left_out: set[str] | None) -> str:
    """`left_out`: those that for_each_record() leaves out; None: without that function."""
    records = [struct for struct in own.structs.values() if struct.name not in LEFT_OUT]
    words = list(own.enumerations.values())
    text = "// The members of structs, made by records/make.\n#pragma once\n\n"
    text += "".join(f'#include "{include_of(header)}"\n' for header in includes)
    base = "record" if left_out is not None else "records"
    text += f'#include "output/{base}.hpp"\n\nnamespace gearlash::records {{\n\n'
    text += "".join(words_text(enumeration) for enumeration in words)
    text += "".join(record_text(struct) for struct in records)
    if left_out is not None:
        listed = [struct for struct in own.structs.values() if struct.name not in left_out]
        text += visits_text("for_each_record", listed) + visits_text("for_each_enumeration", words)
    return text + "}  // namespace gearlash::records\n"


def visits_text(name: str, of: list) -> str:
    calls = "".join(f"  visit(static_cast<const {qualified(one)}*>(nullptr));\n" for one in of)
    return f"template <class Visit>\nvoid {name}(Visit visit) {{\n{calls}}}\n\n"
