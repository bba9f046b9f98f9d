#!/usr/bin/env python3
"""Compares the answers of two builds of portable_answers.

  compare_answers.py FIRST SECOND

FIRST and SECOND are programs, which are run, or texts that they printed. A program that ends in .js
is run by node. Words and numbers without a unit must be equal. The difference of two numbers with
units may be the number of units of FACTORS. Exit status: 0 alike, 1 not, 77 if a program or node is
missing.
"""
import argparse
import collections
import concurrent.futures
import math
import os
import pathlib
import shutil
import subprocess
import sys

# Units that the numbers of two builds may differ by (portable_answers.hpp, and where each kind is
# printed): some four times the largest difference measured between gcc 12 with glibc 2.36 and
# Emscripten 3.1.6 with musl, in brackets. For servos, the largest of 40,000 from four seeds.
FACTORS = {
    ("servo", "growth"): 2,  # [0.57]
    ("servo", "amplitude"): 14,  # [3.6]
    ("servo", "period"): 4,  # [0.94]
    ("servo", "multiplier"): 14,  # [3.5]
    ("bouncing-servo", "growth"): 2,  # [0.47]
    ("bouncing-servo", "amplitude"): 16,  # [3.9]
    ("bouncing-servo", "period"): 20,  # [5.1]
    ("bouncing-servo", "multiplier"): 30,  # [7.6]
    ("cycle", "amplitude"): 3,  # [0.70]
    ("cycle", "motor_amplitude"): 3,  # [0.43]
    ("cycle", "period"): 3,  # [0.23]
    ("cycle", "multiplier"): 40,  # [9.9]
    ("unstable-cycle", "amplitude"): 110,  # [28]
    ("unstable-cycle", "motor_amplitude"): 110,  # as the load's [2.4]
    ("unstable-cycle", "period"): 40,  # [9.2]
    ("unstable-cycle", "multiplier"): 55,  # [14]
    # Of irregular motion the units are standard deviations.
    ("irregular", "amplitude"): 1,
    ("irregular", "mean_amplitude"): 4,
    ("irregular", "mean_period"): 4,
    ("swings", "amplitude"): 1,
    ("swings", "mean_amplitude"): 5,
    ("swings", "mean_period"): 5,
}
# A difference that may exceed this share of the number decides nothing, but of irregular motion.
COARSEST = 1e-5
EXACT_KINDS = ("servo", "bouncing-servo", "cycle", "unstable-cycle")
# Lines that there must be at least, so that two texts cut short do not agree.
LEAST = {"servo": 9000, "bouncing-servo": 1000, "drive": 55, "cycle": 50,
         "unstable-cycle": 20, "irregular": 10, "swings": 2}
MISSING = 77  # CTest counts it as a skipped test


def cases_of(text):
    """{(kind, name): {key: value}}, the lines of the output."""
    cases = {}
    for line in text.splitlines():
        kind, name, *fields = line.split()
        if (kind, name) in cases:
            raise ValueError(f"{kind} {name} is there twice")
        cases[kind, name] = dict(field.split("=", 1) for field in fields)
    return cases


def number_and_unit(value):
    """A pair for <number>~<unit>, else None."""
    number, mark, unit = value.partition("~")
    return (float.fromhex(number), float.fromhex(unit)) if mark else None


def units_between(kind, key, before, after):
    """The difference of two numbers in units, and a fault or None."""
    (first, first_unit), (second, second_unit) = before, after
    unit = max(first_unit, second_unit)
    difference = abs(first - second)
    if not all(map(math.isfinite, (first, second, first_unit, second_unit))):
        return math.inf, "not finite"
    factor = FACTORS[kind, key]
    if kind in EXACT_KINDS and factor * unit > COARSEST * max(abs(first), abs(second)):
        return math.inf, "so badly conditioned that nothing is compared"
    units = 0.0 if difference == 0.0 else difference / unit if unit > 0.0 else math.inf
    return units, f"{units:.3g} units, {factor} permitted" if units > factor else None


def differences(first, second, least=None):
    """All faults, as lines; and of each kind of number its count and the largest difference."""
    faults = []
    worst = collections.defaultdict(lambda: [0, 0.0, ""])
    for kind, count in (LEAST if least is None else least).items():
        found = sum(case[0] == kind for case in first)
        if found < count:
            faults.append(f"{found} lines of {kind}, not {count}")
    for case in sorted(first.keys() ^ second.keys()):
        faults.append(f"{' '.join(case)}: only in the {'first' if case in first else 'second'}")
    for case in (case for case in first if case in second):
        kind, name = case
        before, after = first[case], second[case]
        for key in {**before, **after}:
            old, new = before.get(key, "nothing"), after.get(key, "nothing")
            numbers = number_and_unit(old), number_and_unit(new)
            if None in numbers:
                if old != new:
                    faults.append(f"{kind} {name}: {key}: {old} and {new}")
                continue
            units, fault = units_between(kind, key, *numbers)
            if fault:
                faults.append(f"{kind} {name}: {key}: {old} and {new}: {fault}")
            entry = worst[kind, key]
            entry[0] += 1
            if units > entry[1]:
                entry[1:] = units, name
    return faults, worst


def output_of(path):
    """What a program prints, or a text as it is."""
    if os.access(path, os.X_OK) or path.suffix == ".js":
        command = [path.resolve()]
        if path.suffix == ".js":
            command.insert(0, shutil.which("node") or shutil.which("nodejs"))
        return subprocess.run(command, check=True, capture_output=True, encoding="ascii").stdout
    return path.read_text(encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs=2, type=pathlib.Path, metavar="PROGRAM-OR-TEXT")
    paths = parser.parse_args().paths
    missing = [str(path) for path in paths if not path.exists()]
    if any(path.suffix == ".js" for path in paths) and not (shutil.which("node")
                                                            or shutil.which("nodejs")):
        missing.append("node")
    if missing:
        print("skipped: there is no " + ", no ".join(missing))
        return MISSING
    with concurrent.futures.ThreadPoolExecutor() as pool:
        first, second = pool.map(lambda path: cases_of(output_of(path)), paths)
    faults, worst = differences(first, second)
    for (kind, key), (count, units, name) in sorted(worst.items()):
        permitted = FACTORS[kind, key]
        where = f", {kind} {name}" if name else ""
        print(f"{kind} {key}: {count}; largest difference {units:.3g} units of {permitted}{where}")
    print(f"{len(first)} cases, {len(faults)} faults", *faults, sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
