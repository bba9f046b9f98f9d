#!/usr/bin/env python3
"""Tests that compare_answers.py refuses what a build must not print.

  compare_answers_test.py PROGRAM

PROGRAM is portable_answers, whose own lines are doctored.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import compare_answers

PROGRAM = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else "portable_answers")
SCRIPT = pathlib.Path(compare_answers.__file__)

SERVO = {"damping": "0x1p-3", "verdict": "hunts", "amplitude": "0x1p+0~0x1p-52"}
CYCLE = {"kind": "symmetric", "period": "0x1p+0~0x1p-50"}
SWINGS = {"verdict": "hunts-irregularly", "mean_period": "0x1.8p+2~0x1p-10"}


def moved(value, units):
    """<number>~<unit>, so many units larger."""
    number, unit = compare_answers.number_and_unit(value)
    return f"{(number + units * unit).hex()}~{unit.hex()}"


def faults(changes, **others):
    """Of the three cases above against themselves with changes of one of them."""
    first = {("servo", "0"): SERVO, ("cycle", "0.0"): CYCLE, ("swings", "0"): SWINGS}
    second = {case: dict(fields) for case, fields in first.items()}
    for (kind, key), value in changes.items():
        name = next(name for other, name in first if other == kind)
        second[kind, name][key] = value
    return compare_answers.differences(first, second, others.get("least", {}))[0]


class Differences(unittest.TestCase):
    def test_the_same_is_alike(self):
        self.assertEqual(faults({}), [])

    def test_a_number_within_its_units_is_alike_and_one_beyond_is_not(self):
        for kind, key, fields in (("servo", "amplitude", SERVO), ("cycle", "period", CYCLE),
                                  ("swings", "mean_period", SWINGS)):
            factor = compare_answers.FACTORS[kind, key]
            self.assertEqual(faults({(kind, key): moved(fields[key], factor)}), [])
            self.assertEqual(faults({(kind, key): moved(fields[key], -factor)}), [])
            self.assertEqual(len(faults({(kind, key): moved(fields[key], factor + 1)})), 1)
            self.assertEqual(len(faults({(kind, key): moved(fields[key], -factor - 1)})), 1)

    def test_words_and_data_must_be_equal(self):
        self.assertEqual(len(faults({("servo", "verdict"): "cannot-hunt"})), 1)
        self.assertEqual(len(faults({("servo", "damping"): "0x1.0000000000001p-3"})), 1)
        self.assertEqual(len(faults({("cycle", "kind"): "asymmetric"})), 1)

    def test_what_is_not_finite_is_refused(self):
        for value in ("nan~0x1p-52", "inf~0x1p-52", "0x1p+0~nan", "0x1p+0~inf"):
            self.assertEqual(len(faults({("servo", "amplitude"): value})), 1, value)

    def test_a_unit_that_permits_anything_is_refused(self):
        self.assertEqual(len(faults({("servo", "amplitude"): "0x1p+0~0x1p-10"})), 1)
        self.assertEqual(len(faults({("cycle", "period"): "0x1p+0~0x1p+3"})), 1)

    def test_a_number_that_is_missing_or_new_is_refused(self):
        self.assertEqual(len(faults({("servo", "period"): "0x1p+0~0x1p-52"})), 1)
        self.assertEqual(len(faults({("servo", "amplitude"): "nothing"})), 1)

    def test_texts_cut_short_are_refused(self):
        self.assertEqual(faults({}, least={"servo": 1}), [])
        self.assertEqual(len(faults({}, least={"servo": 2})), 1)
        self.assertEqual(len(compare_answers.differences({}, {})[0]), len(compare_answers.LEAST))


class Program(unittest.TestCase):
    """The program's own lines, with one number or word changed."""

    @classmethod
    def setUpClass(cls):
        cls.text = subprocess.run([PROGRAM.resolve()], check=True, capture_output=True,
                                  encoding="ascii").stdout
        cls.cases = compare_answers.cases_of(cls.text)

    def status(self, text):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder) / name for name in ("first.txt", "second.txt")]
            for path, content in zip(paths, (self.text, text)):
                path.write_text(content, encoding="ascii")
            return subprocess.run([sys.executable, SCRIPT, *paths], stdout=subprocess.DEVNULL,
                                  check=False).returncode

    def a_number(self, kind, key):
        """A case, and the text of one of its numbers, that has a unit above 0."""
        for case, fields in self.cases.items():
            value = fields.get(key, "")
            if case[0] == kind and value and compare_answers.number_and_unit(value)[1] > 0.0:
                return case, value
        self.fail(f"the program prints no {kind} {key}")

    def test_itself(self):
        self.assertEqual(self.status(self.text), 0)

    def test_one_number_moved_in_the_text(self):
        _, value = self.a_number("servo", "amplitude")
        factor = compare_answers.FACTORS["servo", "amplitude"]
        doctored = self.text.replace(value, moved(value, 1.5 * factor), 1)
        self.assertNotEqual(doctored, self.text)
        self.assertEqual(self.status(doctored), 1)

    def test_each_kind_of_number(self):
        for (kind, key), factor in compare_answers.FACTORS.items():
            case, value = self.a_number(kind, key)
            doctored = {**self.cases[case], key: moved(value, 1.5 * factor)}
            found, _ = compare_answers.differences(self.cases, {**self.cases, case: doctored})
            self.assertEqual(len(found), 1, f"{kind} {key}")
            self.assertIn(" ".join(case), found[0])

    def test_a_verdict_and_a_lost_cycle(self):
        self.assertEqual(self.status(self.text.replace("=hunts ", "=undecided ", 1)), 1)
        lines = self.text.splitlines(keepends=True)
        index = next(i for i, line in enumerate(lines) if line.startswith("cycle "))
        self.assertEqual(self.status("".join(lines[:index] + lines[index + 1:])), 1)

    def test_a_missing_build_is_skipped(self):
        missing = subprocess.run([sys.executable, SCRIPT, PROGRAM, "missing/portable_answers.js"],
                                 stdout=subprocess.DEVNULL, check=False)
        self.assertEqual(missing.returncode, compare_answers.MISSING)


if __name__ == "__main__":
    unittest.main()
