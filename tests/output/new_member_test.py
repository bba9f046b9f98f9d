#!/usr/bin/env python3
"""A member that is added to a struct is in JSON, schema, Python and TypeScript without another edit.

Usage: new_member_test.py MAKE HEADER
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

MEMBER = "  std::optional<double> extra_load{};  ///< kg, on top\n"
VALUE = {"schema": "gearlash/made-up/1", "units": "SI", "wheel": {"radius": 1, "width": 2},
         "others": [], "mass": None, "colour": "dark blue", "name": None,
         "fastening": {"kind": "feather key", "length": 0}, "limit": "inf", "unknown": None}


def made(make, header, folder):
    """The outputs for a header."""
    methods = folder / "methods.py"
    methods.write_text("class Record:\n    pass\n")
    schemas = folder / "schemas"
    subprocess.run([sys.executable, make, "--members", folder / "a.hpp", "--types", folder / "a.ts",
                    "--python", folder / "a.py", "--methods", methods, "--schemas", schemas,
                    "--of", header], check=True)
    return {"members": (folder / "a.hpp").read_text(), "python": (folder / "a.py").read_text(),
            "types": (folder / "a.ts").read_text(),
            "schema": (schemas / "made-up.schema.json").read_text(),
            "records": json.loads((schemas / "records.schema.json").read_text())}


def accepts(texts, value):
    schema = json.loads(texts["schema"])
    records = {"records.schema.json": texts["records"]}
    resolver = jsonschema.RefResolver("", schema, store=records)
    return jsonschema.Draft202012Validator(schema, resolver=resolver).is_valid(value)


def main():
    make, header = sys.argv[1:]
    text = pathlib.Path(header).read_text()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        copy = folder / "made_up.hpp"
        copy.write_text(text)
        before = made(make, copy, folder)
        copy.write_text(text.replace("  Colour colour =", MEMBER + "  Colour colour ="))
        after = made(make, copy, folder)
    for one in (before, after):
        assert all(word in one["types"] for word in ("{ kind: 'feather key' } & FeatherKey", "width: number;"))
        assert "    def width(self) -> float:" in one["python"]
    for kind in ("members", "python", "types", "schema"):
        assert "extra_load" not in before[kind], kind
        assert "extra_load" in after[kind], kind
    assert 'Member{"extra_load", &gearlash::made_up::Cart::extra_load, "kg"}' in after["members"]
    assert "    extra_load: float | None = None" in after["python"]
    assert "  /** kg, on top */\n  extra_load: number | null;" in after["types"]
    assert json.loads(after["schema"])["properties"]["extra_load"]["description"] == "kg, on top."
    assert accepts(before, VALUE)
    assert not accepts(after, VALUE)
    assert accepts(after, VALUE | {"extra_load": 1.5})
    assert not accepts(after, VALUE | {"extra_load": "much"})
    assert not accepts(before, VALUE | {"colour": "green"})
    assert not accepts(before, VALUE | {"fastening": {"kind": "glue"}})
    print("a new member is in members, schema, types and Python")


if __name__ == "__main__":
    main()
