#!/usr/bin/env python3
"""Makes the JSON Schema of drive files from the list of all parameters.

Usage: drive_schema.py PARAMETERS.json FILE

An editor with a language server of TOML completes keys by it, shows what they mean, and marks keys,
words and ranges that the reader would refuse. No file that the reader takes is refused. The reader
knows more: dimensions of units, and relations between keys.
"""

import json
import re
import sys
from collections import defaultdict
from pathlib import Path

from headers import write

DECIMAL = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
SIGNS = {"any": "[+-]?", "not negative": r"(?:\+?|-(?=[0.]+(?![\d.])))",
         "positive": r"\+?(?=[0.]*[1-9])"}
FORMS_OF_ROBOTS = ("joint", "actuator")
BARE_SECTIONS = ("servo", *FORMS_OF_ROBOTS)  # whose numbers are in SI without a unit
TOLERANCED = {
    "description": "A number with its tolerance: { value, tolerance }, { value, normal }, "
                   "{ min, max } or { lots = [...] }.",
    "type": "object", "additionalProperties": False,
    "anyOf": [{"required": ["value"]}, {"required": ["min", "max"]}, {"required": ["lots"]}],
    "properties": {key: {"description": meaning} for key, meaning in {
        "value": "The nominal value.",
        "tolerance": "The largest deviation to either side, or its share: \"5 %\".",
        "normal": "The standard deviation, or its share of the value: \"2 %\".",
        "min": "The smallest value.", "max": "The largest value.",
        "lots": "Values that occur: a list of values or of { value, weight }."}.items()}}


def range_of(permitted):
    """Which sign a number has, and the largest one."""
    if permitted.startswith("any"):
        return "any", None
    end = re.search(r"(?:…|to) ([\d.e+]+)", permitted)
    is_finite = end and "inf" not in permitted
    sign = "positive" if permitted == "> 0" else "not negative"
    return sign, float(end[1]) if is_finite else None


def number(permitted, has_unit, is_bare):
    """Numbers, texts of them with their units, and tables with tolerances."""
    sign, largest = range_of(permitted)
    limits = {"any": {}, "not negative": {"minimum": 0}, "positive": {"exclusiveMinimum": 0}}[sign]
    limits = limits | ({"maximum": largest} if largest else {})
    plain = rf"(?:inf|{SIGNS[sign]}{DECIMAL})(?:\s*[/:]\s*[+-]?{DECIMAL})?\s*(?:(?:±|\+/?-).*|%)?"
    with_unit = rf"{SIGNS[sign]}{DECIMAL}(?:\s+\S|[^\s\d.]).*"
    forms = []
    if not has_unit or is_bare:
        forms += [{"type": "number"} | limits, {"type": "string", "pattern": rf"^\s*{plain}\s*$"}]
    elif sign != "positive":
        forms += [{"const": 0}, {"type": "string", "pattern": r"^\s*[+-]?0*\.?0*\s*$"}]
    if has_unit:
        forms.append({"type": "string", "pattern": rf"^\s*{with_unit}$"})
    return [*forms, {"$ref": "#/definitions/toleranced"}]


def forms_of(parameter, name):
    """The values that a key may have; `name` is the parameter's own, or another form of it."""
    numbers = {"type": "array", "items": {"type": ["number", "string"]}}
    if parameter["kind"] == "number":
        has_unit = bool(parameter["unit"] if name.get("is_same", True) else name["unit"])
        return number(name["permitted"], has_unit, name["path"].split(".")[0] in BARE_SECTIONS)
    return [{"choice": {"enum": parameter["words"]}, "list": numbers, "file": {"type": "string"},
             "matrix": {"type": "array", "items": numbers}}[parameter["kind"]]]


def described(parameter, name):
    text = parameter["meaning"][0].upper() + parameter["meaning"][1:]
    if parameter["example"] and name.get("is_same", True):
        text += f", such as \"{parameter['example']}\""
    elif name.get("unit"):
        text += f", given in {name['unit']}"
    return text + "."


def of_keys(section, texts, rule=False):
    """A rule for keys of a section."""
    return {"properties": {section: {"properties": {text: rule for text in texts}}}}


class Schema:
    def __init__(self, listed):
        self.listed = listed
        self.words = {}  # of each choice, with the other words for it
        self.keys = defaultdict(list)  # path → the parameters that it gives, each with that name
        for parameter in listed["parameters"]:
            others = parameter["synonyms"]
            self.words[parameter["path"]] = {
                word: [word, *(other for other, of in others.items() if of == word)]
                for word in parameter["words"] if word not in others}
            for name in [parameter, *parameter["aliases"]]:
                self.keys[name["path"]].append((parameter, name))

    def sections(self):
        sections = {name: f"Section [{name}], {contents}."
                    for name, contents in self.listed["sections"].items()}
        sections |= {name: "" for name in (path.split(".")[0] for path in self.keys)
                     if name not in sections}
        return {name: {"description": meaning or f"Section [{name}], in other words.",
                       "type": "object", "additionalProperties": False,
                       "properties": self.keys_of(name)} for name, meaning in sections.items()}

    def keys_of(self, section):
        keys = {}
        for path, given in self.keys.items():
            if path.startswith(section + "."):
                forms = [form for one in given for form in forms_of(*one)]
                distinct = [form for i, form in enumerate(forms) if form not in forms[:i]]
                keys[path.partition(".")[2]] = {
                    "description": " Or: ".join(dict.fromkeys(described(*one) for one in given)),
                    **(distinct[0] if len(distinct) == 1 else {"anyOf": distinct})}
        return keys

    def when(self, path, words):
        """The condition that the file gives one of these words."""
        section, key = path.split(".")
        spelled = [other for word in words for other in self.words[path][word]]
        return {"required": [section], "properties": {
            section: {"required": [key], "properties": {key: {"enum": spelled}}}}}

    def keys_of_other_words(self):
        """A word of a choice rules keys out."""
        ruled_out = defaultdict(lambda: defaultdict(list))
        for path, given in self.keys.items():
            conditions = {other for parameter, _ in given for other in parameter["exists_with"]}
            for other in sorted(conditions):
                words = self.words[other]
                taken = {word for parameter, _ in given
                         for word in parameter["exists_with"].get(other, words)}
                for word in words:
                    if word not in taken:
                        section, key = path.split(".")
                        ruled_out[other, word][section].append(key)
        return [{"if": self.when(path, [word]),
                 "then": {"allOf": [of_keys(*keys) for keys in sections.items()]}}
                for (path, word), sections in ruled_out.items()]

    def required_keys(self):
        """What a section must have, of a drive that is not given in robots' words."""
        rules = []
        for parameter in self.listed["parameters"]:
            names = [name["path"].split(".") for name in [parameter, *parameter["aliases"]]]
            own = names[0][0]
            others = {section for section, _ in names} - {own, "loop", *FORMS_OF_ROBOTS}
            is_of_points = parameter["kind"] == "list" and own != "controller"
            if not parameter["is_required"] or others or is_of_points:
                continue
            for section in sorted({own, "loop"} & {section for section, _ in names}):
                keys = [key for of, key in names if of == section]
                if parameter["kind"] == "file":  # or the points themselves
                    keys.append("times")
                conditions = [self.when(*one) for one in parameter["exists_with"].items()]
                is_given = {"required": [section]} if section == "loop" else \
                    {"allOf": [{"required": [section]}, *conditions]}
                rules.append({"if": is_given, "then": {"properties": {
                    section: {"anyOf": [{"required": [key]} for key in keys]}}}})
        return rules

    def text(self):
        required = [{"if": {"not": {"required": ["servo"]}},
                     "then": {"required": ["motor", "gearbox", "load"],
                              "anyOf": [{"required": ["controller"]}, {"required": ["loop"]}]}},
                    *self.required_keys()]
        of_robots = {"anyOf": [{"required": [section]} for section in FORMS_OF_ROBOTS]}
        return json.dumps({
            "$schema": "http://json-schema.org/draft-07/schema#", "title": "drive of gearlash",
            "description": "A drive, as a TOML file.", "type": "object",
            "additionalProperties": False, "properties": self.sections(),
            "allOf": [{"if": {"not": of_robots}, "then": {"allOf": required}},
                      *self.keys_of_other_words()],
            "definitions": {"toleranced": TOLERANCED}}, indent=1, ensure_ascii=False) + "\n"


def main():
    listed, file = map(Path, sys.argv[1:])
    write(file, Schema(json.loads(listed.read_text(encoding="utf-8"))).text())


if __name__ == "__main__":
    main()
