#!/usr/bin/env python3
"""Every JSON that the tool prints has the shape that docs/schemas publishes.

Usage: json_schema_test.py TOOL
"""

import json
import pathlib
import subprocess
import sys

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]

SERVO = ["--damping", "0.19", "--inertia-ratio", "2", "--friction-ratio", "0.1", "--backlash", "0.3"]
COMMANDS = [
    ["limit-cycle", *SERVO],
    ["limit-cycle", *SERVO, "--restitution", "0.6"],
    ["limit-cycle", *SERVO, "--restitution", "0.9"],
    ["limit-cycle", "--damping", "0", "--inertia-ratio", "1", "--friction-ratio", "0",
     "--backlash", "0"],
    ["limit-cycle", "examples/elinco-fd162.toml", "--sensitivities", "--margins"],
    ["limit-cycle", *SERVO, "--sensitivities", "--margins"],
    ["limit-cycle", "examples/normalized.toml"],
    ["limit-cycle", "examples/robot-joint.toml"],
    ["limit-cycle", "examples/elinco-fd162.toml", "--set", "contact.stiffness=5 N m/rad"],
    ["limit-cycle", "examples/elinco-fd162.toml", "--set", "reference.kind=sine", "--set",
     "reference.amplitude=1 deg", "--set", "reference.frequency=1 Hz"],
    ["describe", *SERVO],
    ["describe", "examples/telescope-axis.toml"],
    ["design", "examples/elinco-fd162.toml", "--target", "no-hunting", "--parameters",
     "gearbox.backlash,gearbox.ratio,tachometer,load.inertia"],
    ["design", *SERVO, "--target", "amplitude <= 0.1", "--parameters", "backlash,servo.damping"],
    ["tolerance", "examples/toleranced.toml", "--samples", "512"],
    ["tolerance", "examples/toleranced.toml", "--samples", "512", "--target", "amplitude <= 1 deg",
     "--yield", "95 %"],
    ["show", *SERVO],
    ["show", "examples/robot-joint.toml"],
    ["show", "examples/telescope-axis.toml"],
]


def schema_of(name):
    """The schema that the answer names: "gearlash/limit-cycle/2" is limit-cycle.schema.json."""
    path = ROOT / "docs" / "schemas" / f"{name.split('/')[1]}.schema.json"
    return json.loads(path.read_text(encoding="utf-8"))


def refuse_nan(text):
    raise ValueError(f"{text} is no JSON")


def main():
    tool = sys.argv[1]
    for words in COMMANDS:
        run = subprocess.run([tool, *words, "--format", "json"], cwd=ROOT, capture_output=True,
                             text=True, check=False)
        if run.returncode not in (0, 1):
            sys.exit(f"{' '.join(words)}: exit status {run.returncode}: {run.stderr}")
        answer = json.loads(run.stdout, parse_constant=refuse_nan)
        if answer["schema"].split("/")[1] != words[0]:
            sys.exit(f"{' '.join(words)}: schema {answer['schema']}")
        schema = schema_of(answer["schema"])
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(answer)
        print("valid:", " ".join(words))


if __name__ == "__main__":
    main()
