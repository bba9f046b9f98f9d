#!/usr/bin/env python3
"""The schema of drive files takes what the reader takes, and refuses most of what it refuses.

Usage: drive_schema_test.py TOOL SCHEMA PARAMETERS
"""

import json
import pathlib
import random
import re
import subprocess
import sys
import tomllib

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
COUNT = 300
EXAMPLES = [path for path in sorted(ROOT.glob("examples/**/*.toml"))
            if path.parent.name != "faulty" and path.name != "sweep.toml"]


def toml_of(drive):  # JSON writes numbers, texts and lists as TOML does
    def value(of):
        if isinstance(of, dict):
            return "{ " + ", ".join(f"{key} = {value(one)}" for key, one in of.items()) + " }"
        return json.dumps(of, ensure_ascii=False)
    return "".join(f"[{section}]\n" + "".join(f"{key} = {value(of)}\n" for key, of in keys.items())
                   for section, keys in drive.items())


def usual(rng, parameter):
    value = rng.uniform(parameter["usual_low"], parameter["usual_high"])
    return f"{value:.3g} {parameter['unit'] or ''}".strip()


def random_options(rng, parameters):
    """Some numbers and words, and what the words require."""
    options = []
    for parameter in rng.sample(parameters, rng.randrange(1, 5)):
        if parameter["kind"] == "number":
            options.append((parameter["path"], usual(rng, parameter)))
        elif parameter["kind"] == "choice":
            word = rng.choice(parameter["words"])
            options.append((parameter["path"], word))
            options += [(other["path"], usual(rng, other)) for other in parameters
                        if other["is_required"] and other["kind"] == "number"
                        and word in other["exists_with"].get(parameter["path"], [])]
    return [f"--set={path}={value}" for path, value in options]


def mutated(rng, drive, parameters):
    """The drive with one fault in a key, a word or a range, and the path of what has it."""
    drive = {section: dict(keys) for section, keys in drive.items()}
    section = rng.choice(list(drive))
    key = rng.choice(list(drive[section]))
    value = drive[section][key]
    fault = rng.choice(["misspelled", "of another drive", "left out", "value"])
    if fault == "misspelled":
        place = rng.randrange(len(key))
        key = key[:place] + key[place + 1:] or "x"
        drive[section][key] = value
    elif fault == "of another drive":
        other = rng.choice([one for one in parameters if one["usual_high"] > one["usual_low"]])
        section, key = other["path"].split(".")
        if section not in drive:
            return None
        drive[section][key] = usual(rng, other)
    elif fault == "left out":
        del drive[section][key]
    elif isinstance(value, (int, float)):
        drive[section][key] = rng.choice([-1, 0, 1.5]) * (value or 1)
    elif isinstance(value, str) and (number := re.match(r"[-+.\d]+(?:e[-+]?\d+)?", value)):
        drive[section][key] = rng.choice(["-", "0", "-0"]) + value[number.end():] \
            if rng.random() < 0.3 else f"-{value.lstrip('+-')}"
    elif isinstance(value, str):
        drive[section][key] = rng.choice(["dc", value[:-1], value.upper() + "S"])
    else:
        return None
    return drive, f"{section}.{key}"


def concerns(error, section, key):
    """Whether the error is of that key, or that it is missing or unknown in its section."""
    place = list(error.absolute_path)
    is_of_key = f"'{key}'" in f"{error.message} {error.validator_value}"
    is_of_section = place == [section] and error.validator in ("anyOf", "additionalProperties")
    return place[:2] == [section, key] or (is_of_section and is_of_key)


def main():
    tool, schema, listed = sys.argv[1:]
    schema = json.loads(pathlib.Path(schema).read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    parameters = json.loads(pathlib.Path(listed).read_text(encoding="utf-8"))["parameters"]
    rng = random.Random(47)

    def show(drive, *options):
        return subprocess.run([tool, "show", drive, *options], capture_output=True, text=True)

    def read(drive):
        folder = EXAMPLES[0].parent  # of the files that it names
        return subprocess.run([tool, "show", "-"], input=toml_of(drive), capture_output=True,
                              text=True, cwd=folder)

    def takes(drive):
        return next(validator.iter_errors(drive), None) is None

    drives = [tomllib.loads(path.read_text(encoding="utf-8")) for path in EXAMPLES]
    assert all(takes(drive) for drive in drives)
    shown = 0
    while shown < COUNT:
        run = show(rng.choice(EXAMPLES), *random_options(rng, parameters))
        if run.returncode == 0:
            shown += 1
            drive = tomllib.loads(run.stdout)
            assert takes(drive), run.stdout
            drives += [drive] if shown % 10 == 0 else []
    refused = found = 0
    missed = []
    while refused < COUNT:
        of = mutated(rng, rng.choice(drives), parameters)
        if of is None:
            continue
        drive, path = of
        run = read(drive)
        section, key = path.split(".")
        errors = list(validator.iter_errors(drive))
        if run.returncode == 0:
            assert not errors, (path, toml_of(drive))
        elif re.search(rf": {re.escape(path)} ", run.stderr):
            refused += 1
            is_found = any(concerns(error, section, key) for error in errors)
            found += is_found
            missed += [] if is_found else [run.stderr]
    print(f"{COUNT} drives pass; of {refused} faulty ones the schema refuses {found}")
    if found < 0.85 * refused:
        sys.exit("".join(missed))


if __name__ == "__main__":
    main()
