"""TypeScript's types of records, as JSON has them."""

import re

from headers import Member, Source, Struct, inner_types, may_be_null, plain
from json_schemas import in_words

SIMPLE = {"double": "number", "bool": "boolean", "std::monostate": "null",
          "Drive": "Record<string, number | string | null | unknown[]>",
          "std::complex<double>": "{ real: number; imaginary: number }", "MapCurve": "Column"}


def type_of(name: str, source: Source) -> str:
    outer, inner = inner_types(name)
    if outer == "optional":
        return f"{type_of(inner[0], source)} | null"
    if outer == "variant":
        return " | ".join(type_of(kind, source) for kind in inner)
    if outer == "ByName":
        return f"Record<string, {type_of(inner[0], source)}>"
    if outer in ("vector", "span"):
        of, pair = inner_types(inner[0])
        if of == "pair":
            return f"Record<string, {type_of(pair[1], source)}>"
        item = type_of(inner[0], source)
        return f"({item})[]" if "|" in item else f"{item}[]"
    if name in SIMPLE:
        return SIMPLE[name]
    if name.startswith("std::string"):
        return "string"
    if re.fullmatch(r"int|std::size_t|std::u?int\\d+_t", name):
        return "number"
    if plain(name) in source.aliases:
        return type_of(source.aliases[plain(name)], source)
    return plain(name)


def member_text(member: Member, source: Source) -> str:
    of = type_of(member.type, source)
    if may_be_null(member):
        of += " | null"
    comment = f"  /** {member.comment} */\n" if member.comment else ""
    return f"{comment}  {member.name}: {of};\n"


def alternative(kind: str, source: Source) -> str:
    """One of a variant; a struct names its kind."""
    of = type_of(kind, source)
    return f"({{ kind: '{in_words(of)}' }} & {of})" if of in source.structs else of


def interface_text(struct: Struct, source: Source) -> str:
    members = "".join(member_text(member, source) for member in struct.all_members)
    comment = f"/** {struct.comment} */\n" if struct.comment else ""
    return f"{comment}export interface {struct.name} {{\n{members}}}\n\n"


def types_text(source: Source) -> str:
    text = ("// The records that the core gives, made by records/make.\n\n"
            "/** Points beside the JSON, x and y by turns. */\n"
            "export interface Column {\n  at: number;\n  count: number;\n}\n\n")
    for name, enumeration in source.enumerations.items():
        words = " | ".join(f"'{word}'" for word in enumeration.words) or "string"
        text += f"export type {name} = {words};\n\n"
    for name, variant in source.variants.items():
        kinds = " | ".join(alternative(kind, source) for kind in variant.kinds)
        text += f"export type {name} = {kinds};\n\n"
    return text + "".join(interface_text(struct, source)
                          for name, struct in source.structs.items() if name != "Drive")
