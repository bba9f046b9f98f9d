"""JSON Schemas of the documents that the tool prints, from the structs that they are.

records.schema.json has every type; VERB.schema.json refers to them.
"""

import json
import re

from headers import Member, Source, Struct, inner_types, may_be_null, plain

RECORDS = "records.schema.json"
NULL = {"type": "null"}
SIMPLE = {
    "double": {"$ref": f"{RECORDS}#/$defs/number"},
    "bool": {"type": "boolean"},
    "Drive": {"$ref": f"{RECORDS}#/$defs/Drive"},
    "std::monostate": NULL,
    "std::complex<double>": {"$ref": f"{RECORDS}#/$defs/complex"},
}
BASIC = {
    "number": {"description": "A number in SI units; infinity is a text.",
               "anyOf": [{"type": "number"}, {"enum": ["inf", "-inf"]}]},
    "complex": {"description": "A complex number.", "type": "object",
                "additionalProperties": False, "required": ["real", "imaginary"],
                "properties": {"real": {"$ref": "#/$defs/number", "description": "Its real part."},
                               "imaginary": {"$ref": "#/$defs/number",
                                             "description": "Its imaginary part."}}},
    "Drive": {"description": "Every parameter of the drive by its path, in SI units; null for one "
                             "that is not given and has no default.",
              "type": "object",
              "additionalProperties": {"type": ["number", "string", "array", "null"]}},
}


def or_null(schema: dict) -> dict:
    if isinstance(schema.get("type"), str) and schema["type"] != "null":
        return schema | {"type": [schema["type"], "null"]}
    return {"anyOf": [*schema["anyOf"], NULL] if "anyOf" in schema else [schema, NULL]}


def schema_of(name: str, source: Source) -> dict:
    outer, inner = inner_types(name)
    if outer == "optional":
        return or_null(schema_of(inner[0], source))
    if outer == "variant":
        return {"anyOf": [schema_of(kind, source) for kind in inner]}
    if outer == "ByName":
        return {"type": "object", "additionalProperties": schema_of(inner[0], source)}
    if outer in ("vector", "span"):
        of, pair = inner_types(inner[0])
        if of == "pair":  # of a name and a value
            return {"type": "object", "additionalProperties": schema_of(pair[1], source)}
        return {"type": "array", "items": schema_of(inner[0], source)}
    if outer == "RowsOf":
        return {"type": "object", "additionalProperties": False, "required": ["columns", "rows"],
                "properties": {"columns": {"type": "array", "items": {"type": "string"},
                                           "description": "The names of a row's values."},
                               "rows": {"type": "array", "items": {"type": "array"},
                                        "description": "The values of each row."}}}
    if name in SIMPLE:
        return SIMPLE[name]
    if name.startswith("std::string"):
        return {"type": "string"}
    if re.fullmatch(r"int|std::size_t|std::u?int\d+_t", name):
        return {"type": "integer"}
    if plain(name) in source.aliases:
        return schema_of(source.aliases[plain(name)], source)
    return {"$ref": f"{RECORDS}#/$defs/{plain(name)}"}


def member_schema(member: Member, source: Source) -> dict:
    schema = schema_of(member.type, source)
    if may_be_null(member):
        schema = or_null(schema)
    elif "NaN" in member.comment:  # numbers in a list
        number = SIMPLE["double"]
        schema = json.loads(json.dumps(schema).replace(json.dumps(number),
                                                       json.dumps(or_null(number))))
    return {"description": sentence(member.comment or member.name.replace("_", " "))} | schema


def sentence(comment: str) -> str:
    """In the words of JSON, without the name of a document."""
    comment = re.sub(r'^"gearlash/[^"]*": ', "", comment)
    for cpp, of_json in (("NaN", "null"), ("nullptr", "null"), ("::", ".")):
        comment = comment.replace(cpp, of_json)
    return comment if comment.endswith((".", "…")) else comment + "."


def opened_members(struct: Struct, source: Source) -> list[Member]:
    """Its members as a document has them, each name once."""
    members = [inner for member in struct.all_members
               for inner in (source.structs[member.type].all_members
                             if member.is_opened(struct) else [member])]
    names = [member.name for member in members]
    if len(set(names)) < len(names):
        raise ValueError(f"{struct.name} has two members of one name: {names}")
    return members


def object_of(struct: Struct, source: Source, first: dict, last: dict) -> dict:
    properties = first | {member.name: member_schema(member, source)
                          for member in opened_members(struct, source)} | last
    return {"description": sentence(struct.comment) if struct.comment else
            f"{in_words(struct.name).capitalize()}.",
            "type": "object", "additionalProperties": False, "required": list(properties),
            "properties": properties}


def in_words(name: str) -> str:
    """RelayWithHysteresis is "relay with hysteresis"."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()


def alternative(kind: str, source: Source) -> dict:
    """One of a variant; a struct names its kind."""
    struct = source.structs.get(plain(kind))
    if struct is None:
        return schema_of(kind, source)
    first = {"kind": {"description": "Which of the alternatives this is.",
                      "const": in_words(struct.name)}}
    return object_of(struct, source, first, {})


def records_schema(source: Source) -> dict:
    definitions = dict(BASIC)
    for name, struct in source.structs.items():
        if not struct.document and name != "Drive":
            definitions[name] = object_of(struct, source, {}, {})
    for name, enumeration in source.enumerations.items():
        of = {"enum": enumeration.words} if enumeration.words else {"type": "string"}
        definitions[name] = {"description": f"{in_words(name).capitalize()}, a word."} | of
    for name, variant in source.variants.items():
        definitions[name] = {"description": f"{in_words(name).capitalize()}, by its kind.",
                             "anyOf": [alternative(kind, source) for kind in variant.kinds]}
    text = json.dumps({"$schema": "https://json-schema.org/draft/2020-12/schema",
                       "title": "records of the JSON documents", "$defs": definitions})
    return json.loads(text.replace(f'"{RECORDS}#', '"#'))


def document_schema(struct: Struct, source: Source) -> dict:
    verb = struct.document.split("/")[1]
    first = {"schema": {"description": "The name and the version of this shape.",
                        "const": struct.document},
             "units": {"description": "Those of all numbers: rad, rad/s, s, Hz, N m, kg m².",
                       "const": "SI"}}
    has_drive = any(member.type == "Drive" for member in struct.members)
    last = {"defaults": {"description": "The paths of the drive's parameters that have their "
                                        "default value.",
                         "type": "array", "items": {"type": "string"}}} if has_drive else {}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": f"gearlash {verb} --format json"} | object_of(struct, source, first, last)


def schemas(source: Source) -> dict[str, str]:
    """The text of each file by its name."""
    files = {RECORDS: records_schema(source)}
    for struct in source.structs.values():
        if struct.document:
            files[f"{struct.document.split('/')[1]}.schema.json"] = document_schema(struct, source)
    return {name: json.dumps(schema, indent=2, ensure_ascii=False) + "\n"
            for name, schema in files.items()}
