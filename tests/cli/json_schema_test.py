#!/usr/bin/env python3
"""Every JSON that the tool prints has the shape of the schemas that the build makes.

Usage: json_schema_test.py TOOL SCHEMAS
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]

SERVO = ["--damping", "0.19", "--inertia-ratio", "2", "--friction-ratio", "0.1", "--backlash", "0.3"]
HUNTING_JOINT = ["examples/symptoms/joint.toml", "--set", "motor.coulomb=0", "--set",
                 "load.coulomb=0"]
COMMANDS = [
    ["limit-cycle", *SERVO],
    ["limit-cycle", *SERVO, "--restitution", "0.6"],
    ["limit-cycle", *SERVO, "--restitution", "0.9"],
    ["limit-cycle", "--damping", "0", "--inertia-ratio", "1", "--friction-ratio", "0",
     "--backlash", "0"],
    ["limit-cycle", "examples/elinco-fd162.toml", "--sensitivities", "--margins"],
    ["limit-cycle", *SERVO, "--sensitivities", "--margins"],
    ["limit-cycle", "examples/dynamixel-joint.toml"],
    ["limit-cycle", *HUNTING_JOINT, "--margins", "--parameters", "load.coulomb=0:0.2 N m:9"],
    ["limit-cycle", "examples/normalized.toml"],
    ["limit-cycle", "examples/robot-joint.toml", "--specification", "3 deg"],
    ["limit-cycle", "examples/elinco-fd162.toml", "--set", "contact.stiffness=5 N m/rad"],
    ["limit-cycle", "examples/elinco-fd162.toml", "--set", "reference.kind=sine", "--set",
     "reference.amplitude=1 deg", "--set", "reference.frequency=1 Hz"],
    ["describe", *SERVO],
    ["describe", "examples/telescope-axis.toml"],
    ["simulate", *SERVO],
    ["simulate", *SERVO, "--restitution", "0.6", "--initial-gap", "0", "--initial-gap-speed", "-1"],
    ["simulate", "examples/elinco-fd162.toml", "--until", "0.5"],
    ["simulate", "examples/robot-joint.toml", "--until", "1"],
    ["simulate", "examples/telescope-axis.toml", "--until", "1"],
    ["compare", "examples/elinco-fd162.toml"],
    ["compare", *SERVO, "--x", "restitution=0:0.6:3"],
    ["compare", "examples/robot-joint.toml", "examples/dynamixel-joint.toml", "--quantities",
     "verdict,amplitude"],
    ["compare", "examples/robot-joint.toml", "--time-limit", "1 us"],
    ["chart", "--x", "damping=0.1:0.6:3", "--curves", "inertia-ratio=0,1,inf", "--friction-ratio",
     "0.2"],
    ["chart", "examples/elinco-fd162.toml", "--x", "sensor.position=load,motor"],
    ["map", "--x", "damping=0.1:0.9:9", "--y", "friction-ratio=0.1:0.9:9", "--inertia-ratio", "1"],
    ["map", "examples/elinco-fd162.toml", "--x", "gearbox.ratio=1,2", "--y",
     "sampling.period=1 ms,10 ms"],
    ["map", "examples/elinco-fd162.toml", "--x", "load.friction=1e-5:1e-3:5:log", "--y",
     "controller.proportional=1,10", "--target", "no-hunting and bandwidth >= 1 Hz"],
    ["design", "examples/elinco-fd162.toml", "--target", "no-hunting", "--parameters",
     "gearbox.backlash,gearbox.ratio,controller.motor_speed_feedback,load.inertia"],
    ["design", *SERVO, "--target", "amplitude <= 0.1", "--parameters", "backlash,servo.damping"],
    ["design", *HUNTING_JOINT, "--target", "no-hunting-if-disturbed", "--parameters",
     "sensor.position,load.coulomb=0:0.2 N m:9"],
    ["design", "examples/telescope-axis.toml", "--target", "ceiling <= 6.3 arcmin", "--parameters",
     "gearbox.backlash=5 arcmin:20 arcmin:2"],
    ["tune", "examples/elinco-fd162.toml", "--target", "no-hunting", "--phase-margin", "0 deg"],
    ["tune", "examples/toleranced.toml", "--target", "amplitude <= 1 deg", "--units", "8",
     "--parameters", "load.friction=0.03 ozf in/(rad/s):0.3 ozf in/(rad/s)"],
    ["tolerance", "examples/toleranced.toml", "--samples", "512"],
    ["tolerance", "examples/toleranced.toml", "--samples", "512", "--target", "amplitude <= 1 deg",
     "--yield", "95 %"],
    ["show", *SERVO],
    ["show", "examples/robot-joint.toml"],
    ["show", "examples/dynamixel-joint.toml"],
    ["show", "examples/telescope-axis.toml"],
]


def validate(answer, schemas):
    """By the schema that it names: "gearlash/limit-cycle/3" is limit-cycle.schema.json."""
    path = schemas / f"{answer['schema'].split('/')[1]}.schema.json"
    schema = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    resolver = jsonschema.RefResolver(path.as_uri(), schema)
    jsonschema.Draft202012Validator(schema, resolver=resolver).validate(answer)


def refuse_nan(text):
    raise ValueError(f"{text} is no JSON")


def printed(tool, words):
    """The JSON of a command, which charts and maps write into a file."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "answer.json"
        is_grid = words[0] in ("chart", "map")
        asked = ["--output", str(file)] if is_grid else ["--format", "json"]
        run = subprocess.run([tool, *words, *asked], cwd=ROOT, capture_output=True, text=True,
                             check=False)
        if run.returncode not in (0, 1):
            sys.exit(f"{' '.join(words)}: exit status {run.returncode}: {run.stderr}")
        return file.read_text(encoding="utf-8") if is_grid else run.stdout


def main():
    tool, schemas = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    for words in COMMANDS:
        answer = json.loads(printed(tool, words), parse_constant=refuse_nan)
        is_grid = words[0] in ("chart", "map")
        if answer["schema"].split("/")[1] != ("grid" if is_grid else words[0]):
            sys.exit(f"{' '.join(words)}: schema {answer['schema']}")
        validate(answer, schemas)
        print("valid:", " ".join(words))


if __name__ == "__main__":
    main()
