#!/usr/bin/env python3
"""Writes the reference pages that come from the tool, its registries, schemas and headers.

Usage: generate_reference.py TOOL PARAMETERS.json SCHEMAS HEADERS XML FOLDER
"""

import json
import pathlib
import re
import subprocess
import sys
from xml.etree import ElementTree

SCOPES = {
    "answer": "Of the drive as a whole",
    "motion": "Of the largest stable cycle, else of the largest irregular motion",
    "ceiling": "Of the ceiling",
    "loop": "Of the linear loop with the gap closed",
    "step": "Of a step of the reference",
}


def cell(text):
    """Text that may stand in a table."""
    return str(text).replace("|", "\\|").replace("\n", " ")


def code(text):
    return f"`{text}`" if text else ""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(cell(c) for c in row) + " |" for row in rows]) + "\n"


def number(value):
    return f"{value:g}"


def help_of(tool, *verb):
    run = subprocess.run([tool, *verb, "--help"], capture_output=True, text=True, check=True)
    return run.stdout.rstrip()


def verbs_in(text):
    """The names that the help lists, under several headings, if the usage asks for a verb."""
    lists = text.partition("\nExit status:")[0] if " VERB\n" in text else ""
    return re.findall(r"^  ([a-z][a-z0-9-]*)  ", lists, re.MULTILINE)


def help_block(tool, *verb):
    name = " ".join(("gearlash", *verb, "--help"))
    return f"```text\n$ {name}\n{help_of(tool, *verb)}\n```\n"


def verbs_page(tool):
    top = help_of(tool)
    parts = ["# Verbs\n", "What the tool prints of itself.\n", help_block(tool)]
    for verb in verbs_in(top):
        parts += [f"## gearlash {verb}\n", help_block(tool, verb)]
        for word in verbs_in(help_of(tool, verb)):
            parts += [f"### gearlash {verb} {word}\n", help_block(tool, verb, word)]
    return "\n".join(parts)


def unit_of(parameter):
    """One unit, or one for each word that decides it."""
    for path, units in parameter["units"].items():
        return "; ".join(f"{unit} ({key(path)} = {', '.join(words)})" for unit, words in units.items())
    return parameter["unit"] or "–"


def key(path):
    return path.split(".", 1)[1]


def permitted_of(parameter):
    if parameter["words"]:
        return ", ".join(code(word) for word in parameter["words"])
    return parameter["permitted"] or {"list": "numbers", "matrix": "rows of numbers"}.get(
        parameter["kind"], "a file name")


def default_of(parameter):
    if parameter["is_required"]:
        return "**required**"
    for path, defaults in parameter["defaults"].items():
        return "; ".join(f"{code(word)} ({key(path)} = {', '.join(others)})"
                         for word, others in defaults.items())
    default = parameter["otherwise"]
    if default is None:
        return "none"
    return number(default) if isinstance(default, (int, float)) else code(default)


def usual_of(parameter):
    low, high = parameter["usual_low"], parameter["usual_high"]
    return "–" if low == high else f"{number(low)} … {number(high)}"


def conditions_of(parameter):
    return "; ".join(f"{key(path)} = {', '.join(words)}"
                     for path, words in parameter["exists_with"].items())


def aliases_of(parameter):
    return ", ".join(code(alias["path"]) + (f" ({alias['unit']})" if alias["unit"] else "")
                     for alias in parameter["aliases"])


def meaning_of(parameter):
    text = parameter["meaning"]
    text = text[0].upper() + text[1:] + "."
    if parameter["exists_with"]:
        text += f" *Only with* {conditions_of(parameter)}."
    if parameter["aliases"]:
        text += f" *Also* {aliases_of(parameter)}."
    return text


def parameters_page(listed):
    parts = ["# Parameters\n", """\
Every key of a drive file, from the list that the reader, `gearlash show`, `--set`, axes, designs and
tolerances use. A path is `section.key`. Ranges and defaults are in the unit of the second column;
files and options take any unit of the same kind. The usual range is the one that a study takes if
nothing else is known. [Drives](../drives.md) explains what the keys do.
"""]
    for section in dict.fromkeys(p["path"].split(".")[0] for p in listed["parameters"]):
        rows = [(code(key(p["path"])), unit_of(p), permitted_of(p), usual_of(p), default_of(p),
                 meaning_of(p))
                for p in listed["parameters"] if p["path"].startswith(section + ".")]
        parts += [f"## [{section}]\n",
                  table(("key", "unit", "permitted", "usual", "default", "meaning"), rows)]
    return "\n".join(parts)


def quantities_page(listed):
    parts = ["# Quantities\n", """\
What can be asked of an answer, by name: in targets, charts, maps, sweeps, tables and
`Answer::value()`. A name may be written with `-` for `_`.
"""]
    for scope in dict.fromkeys(q["scope"] for q in listed["quantities"]):
        rows = [(code(q["name"]), q["unit"] or "a word", q["meaning"])
                for q in listed["quantities"] if q["scope"] == scope]
        parts += [f"## {SCOPES[scope]}\n", table(("name", "unit", "meaning"), rows)]
    return "\n".join(parts)


def type_in(schema):
    """The type of a JSON value in words."""
    if "$ref" in schema:
        file, _, place = schema["$ref"].partition("#")
        page = file.replace(".schema.json", ".md")
        name = place.rsplit("/", 1)[-1]
        if not name:
            return f"[{page.removesuffix('.md')}]({page})" if page else "this object again"
        return f"[{code(name)}]({page}#{anchor(name)})"
    if "const" in schema:
        return code(json.dumps(schema["const"]))
    if "enum" in schema:
        return ", ".join(code(json.dumps(word)) for word in schema["enum"])
    for either in ("oneOf", "anyOf"):
        if either in schema:
            return " or ".join(type_in(one) for one in schema[either])
    kinds = schema.get("type", "any")
    kinds = kinds if isinstance(kinds, list) else [kinds]
    words = []
    for kind in kinds:
        items = schema.get("items")
        if kind == "array" and isinstance(items, dict) and set(items) - {"description"}:
            words.append("array of " + type_in(items))
        else:
            words.append(kind)
    return " or ".join(words)


def anchor(name):
    return name.replace("_", "-").lower()


def part_of(schema, path):
    """What a schema refers to, in its own file or another, or the schema itself."""
    file, _, place = schema.get("$ref", "").partition("#/$defs/")
    if not place:
        return schema
    return json.loads((path.parent / (file or path.name)).read_text())["$defs"][place]


def fields_of(schema, path, prefix=""):
    """Rows of a table for an object's fields, those of objects within it after each."""
    for name, field in schema.get("properties", {}).items():
        meaning = field.get("description") or part_of(field, path).get("description")
        if not meaning:
            raise SystemExit(f"{path}: {prefix}{name} has no description")
        yield code(prefix + name), type_in(field), meaning
        yield from fields_of(field, path, f"{prefix}{name}.")
        items = field.get("items")
        if isinstance(items, dict):
            yield from fields_of(items, path, f"{prefix}{name}[].")


def schema_page(path):
    schema = json.loads(path.read_text())
    parts = [f"# JSON of {path.name.split('.')[0]}\n", schema.get("description", "") + "\n"]
    if "properties" in schema:
        parts.append(table(("field", "type", "meaning"), fields_of(schema, path)))
    else:
        parts[0] = f"# {schema['title'][0].upper()}{schema['title'][1:]}\n"
    for name, part in schema.get("$defs", {}).items():
        parts.append(f"## {code(name)}\n")
        meaning = part.get("description") or part_of(part, path).get("description")
        if meaning:
            parts.append(meaning + "\n")
        items = part.get("items")
        of = items if isinstance(items, dict) and "properties" in items else part
        rows = list(fields_of(of, path))
        parts.append(table(("field", "type", "meaning"), rows) if rows else type_in(part) + ".\n")
    return "\n".join(parts)


def index_page(title, text, names):
    listed = "\n".join(names)
    return f"# {title}\n\n{text}\n\n```{{toctree}}\n:maxdepth: 1\n\n{listed}\n```\n"


def text_of(element):
    return "".join(element.itertext()) if element is not None else ""


def types_of(function):
    types = ", ".join(text_of(one.find("type")) for one in function.findall("param"))
    constant = " const" if function.get("const") == "yes" else ""
    return f"({types}){constant}"


def declared_in(xml, header):
    """The directives of what a header declares, in its order: (line, directive)."""
    place = f"include/gearlash/{header.name}"
    for file in xml.glob("*.xml"):
        for whole in ElementTree.parse(file).getroot().findall("compounddef"):
            name = whole.findtext("compoundname")
            location = whole.find("location")
            if whole.get("kind") in ("struct", "class") and location.get("file") == place:
                is_inner = "::" in name.removeprefix("gearlash::").removeprefix("hybrid::")
                if not is_inner:
                    yield int(location.get("line")), f"doxygen{whole.get('kind')}:: {name}"
            if whole.get("kind") == "namespace":
                for member in whole.findall("sectiondef/memberdef"):
                    location = member.find("location")
                    if location.get("file") != place:
                        continue
                    kind = member.get("kind")
                    path = f"{name}::{member.findtext('name')}"
                    if kind == "function":
                        path += types_of(member)
                    yield int(location.get("line")), f"doxygen{kind}:: {path}"


def header_page(header, xml):
    """A page of reStructuredText, which Breathe speaks."""
    purpose = header.read_text().split("\n#")[0].replace("// ", "").strip()
    title = f"gearlash/{header.name}"
    parts = [f"{title}\n{'=' * len(title)}\n", purpose + "\n"]
    for _, directive in sorted(declared_in(xml, header)):
        has_members = directive.startswith(("doxygenstruct", "doxygenclass"))
        members = "   :members:\n   :undoc-members:\n" if has_members else ""
        parts.append(f".. {directive}\n{members}")
    return "\n".join(parts)


def write(path, text):
    """Leaves a page alone that would not change, so that Sphinx does not read it again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def python_page():
    """Every public name of the Python package, by Sphinx from the docstrings."""
    import gearlash  # the package that the build has made

    records = set(gearlash._records.__all__)
    own = [name for name in gearlash.__all__ if name not in records]
    functions = [name for name in own if not isinstance(getattr(gearlash, name), type)
                 and callable(getattr(gearlash, name))]
    classes = [name for name in own if isinstance(getattr(gearlash, name), type)]
    modules = [name for name in own if name not in functions + classes]
    lines = ["Python", "======", "", "``import gearlash``: all numbers are in SI units, angles in "
             "rad.", "", ".. py:module:: gearlash", ""]

    def section(title):
        lines.extend([title, "-" * len(title), ""])

    section("Functions")
    lines.extend(f".. autofunction:: gearlash.{name}\n" for name in functions)
    section("Classes")
    lines.extend(f".. autoclass:: gearlash.{name}\n   :members:\n" for name in classes)
    for name in [*modules, "plot"]:
        section(f"gearlash.{name}")
        lines.append(f".. automodule:: gearlash.{name}\n   :members:\n")
    section("Records")
    lines.append("Values of one kind each, made from the public headers of C++. They take keywords, "
                 "compare equal by their members, never change and can be pickled.\n")
    lines.extend(f".. autoclass:: gearlash.{name}\n   :members:\n   :inherited-members:\n"
                 f"   :exclude-members: {members_of(getattr(gearlash, name))}\n"
                 for name in sorted(records))
    return "\n".join(lines)


def members_of(record):
    """The members of a record, which its own docstring has."""
    import dataclasses

    return ", ".join(member.name for member in dataclasses.fields(record))


def main():
    tool, parameters, schemas, headers, xml, folder = (pathlib.Path(name) for name in sys.argv[1:])
    listed = json.loads(parameters.read_text())
    write(folder / "verbs.md", verbs_page(tool))
    write(folder / "parameters.md", parameters_page(listed))
    write(folder / "quantities.md", quantities_page(listed))

    write(folder / "python.rst", python_page())

    files = sorted(set(schemas.glob("*.schema.json")) - {schemas / "drive.schema.json"})
    for file in files:
        write(folder / "json" / f"{file.name.split('.')[0]}.md", schema_page(file))
    write(folder / "json" / "index.md", index_page(
        "JSON", "The fields of every JSON output, from the schemas that are tested against it.",
        [file.name.split(".")[0] for file in files]))

    files = sorted(headers.glob("*.hpp"))
    for file in files:
        write(folder / "cpp" / f"{file.stem}.rst", header_page(file, xml))
    write(folder / "cpp" / "index.md", index_page(
        "C++", "The public headers, `include/gearlash`. All numbers are in SI units, angles in rad.",
        [file.stem for file in files]))


if __name__ == "__main__":
    main()
