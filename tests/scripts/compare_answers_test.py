"""scripts/compare-answers notices whatever changes in an answer on record, and nothing else.

Usage: compare_answers_test.py
"""
import copy
import itertools
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from compare_answers import answers_of_0_2 as adapter  # noqa: E402
from compare_answers import picture  # noqa: E402
from compare_answers.command import Expected, recorded  # noqa: E402
from compare_answers.differences import bound, differences, enclosure, ranges  # noqa: E402
from compare_answers.questions import KINDS, all_questions  # noqa: E402

RECORD = ROOT / "tests/answers/0.2.json.gz"
CASES_OF_A_KIND, LEAVES = 6, 250

# What may change by a tenth without a difference: what measures how far other values may move, and
# what decides how they are compared.
FREE = {"residual", "swing_deviation", "period_deviation", "rest is approached", "located",
        "is_searched"}


def leaves(value, path=()):
    """The path of each number, word and truth value."""
    if isinstance(value, (dict, list)):
        for key in (value if isinstance(value, dict) else range(len(value))):
            yield from leaves(value[key], (*path, key))
    else:
        yield path


def altered(value, parent, path):
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return value + "1"
    if value in (None, 0, float("inf")):
        return 1.0
    return value * 1.1 + 1e-3 * scale_of(parent, path)


def scale_of(parent, path):
    """Numbers that are nothing beside their scale may change by more than a tenth."""
    numbers = [abs(value) for value in (parent if isinstance(parent, list) else parent.values())
               if isinstance(value, (int, float)) and value != float("inf")]
    of_all = isinstance(parent, list) or {"rest", "energy"} & set(path)
    scales = {"engaged_time": "period", "separated_time": "period", "final_error": "step",
              "ripple": "step"}
    return max(numbers) if of_all else parent.get(scales.get(path[-1]), 0.0)


def unnoticed(case):
    """The values of an answer, each of which may change by itself without a difference."""
    record = case["answer"]["record"]
    changed = copy.deepcopy(record)
    for path in itertools.islice(leaves(record), LEAVES):
        if is_free(record, path):
            continue
        parent = changed
        for key in path[:-1]:
            parent = parent[key]
        value = parent[path[-1]]
        parent[path[-1]] = altered(value, parent, path)
        if not found(case, changed):
            yield case["name"], path, value, parent[path[-1]]
        parent[path[-1]] = value


def is_free(record, path):
    if set(path) & FREE or "curves" in path:
        return True
    if "estimates" in path or "allowance" in path:  # of a series that is searched: by its error
        return bool(record.get("is_searched"))
    return "irregular" in path


def found(case, new):
    return list(differences(case, case["answer"], case["answer"] | {"record": new}))


class OfTheRecord(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cases = {kind: [] for kind in KINDS}
        for case in recorded(RECORD):
            if "record" in case["answer"] and len(cls.cases[case["kind"]]) < CASES_OF_A_KIND:
                cls.cases[case["kind"]].append(case)

    def each(self):
        for cases in self.cases.values():
            yield from cases

    def test_every_kind_of_question_has_answers(self):
        for kind, cases in self.cases.items():
            self.assertGreater(len(cases), 4, kind)

    def test_an_answer_does_not_differ_from_itself(self):
        for case in self.each():
            self.assertEqual(found(case, copy.deepcopy(case["answer"]["record"])), [], case["name"])

    def test_every_change_of_a_value_is_noticed(self):
        self.assertEqual([each for case in self.each() for each in unnoticed(case)], [])

    def test_every_part_that_is_lost_is_noticed(self):
        for case in self.each():
            record = case["answer"]["record"]
            for key in record:
                if key not in FREE:
                    left = {name: value for name, value in record.items() if name != key}
                    if key != "rests" and record[key] not in (False, [], {}):
                        self.assertTrue(found(case, left), f"{case['name']}: {key}")

    def test_curves_that_move_are_noticed(self):
        seen = 0
        for case in self.each():
            record = copy.deepcopy(case["answer"]["record"])
            for curve in record.get("curves", {}).values():
                low, high = min(x for x, _ in curve), max(x for x, _ in curve)
                for point in curve:
                    point[0] += 0.02 * (high - low)
                if high > low:
                    seen += 1
                    self.assertTrue(found(case, record), case["name"])
                    break
        self.assertGreater(seen, 5)

    def test_an_exit_status_is_noticed(self):
        for case in self.each():
            answer = case["answer"] | {"status": "over the limit"}
            self.assertTrue(list(differences(case, case["answer"], answer)))


class Rules(unittest.TestCase):
    def changes(self, differing):
        return [change for _, change, *_ in differing]

    def test_a_bound_may_be_a_little_tighter_and_hardly_weaker(self):
        self.assertEqual(self.changes(bound("", 1.0, 1.0 + 9e-7)), [])
        self.assertEqual(self.changes(bound("", 1.0, 1.0 + 2e-6)), ["weaker"])
        self.assertEqual(self.changes(bound("", 1.0, 0.9995)), [])
        self.assertEqual(self.changes(bound("", 1.0, 0.99)), ["stronger"])
        self.assertEqual(self.changes(bound("", 1.0, 0.99, is_upper=False)), ["weaker"])
        self.assertEqual(self.changes(bound("", 1.0, None)), ["withheld"])
        self.assertEqual(self.changes(bound("", None, 1.0)), ["proved now"])

    def test_an_enclosure_meets_that_on_record(self):
        self.assertEqual(self.changes(enclosure("", [1.0, 1.1], [1.05, 1.06])), [])
        self.assertEqual(self.changes(enclosure("", [1.0, 1.1], [1.11, 1.12])), ["apart"])
        self.assertEqual(self.changes(enclosure("", [1.0, 1.1], [0.0, 2.0])), ["wider"])

    def test_an_end_of_a_range_moves_by_what_it_is_located_to(self):
        self.assertEqual(self.changes(ranges("", [[1.0, 2.0]], [[1.0001, 2.0]], 2e-4)), [])
        self.assertEqual(self.changes(ranges("", [[1.0, 2.0]], [[1.001, 2.0]], 2e-4)), ["number"])
        self.assertEqual(self.changes(ranges("", [[1.0, 2.0]], [], 2e-4)), ["count"])

    def test_expected_differences_are_named_by_pattern_and_case(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write('[[expected]]\ndifference = "ceilings: ceiling.*: withheld"\n'
                       'case = "ceilings 1*"\nreason = "no theorem"\n')
            file.flush()
            expected = Expected(file.name)
        difference = "ceilings: ceiling.load: withheld"
        self.assertEqual(expected.reason_of(difference, {"name": "ceilings 12"}), "no theorem")
        self.assertIsNone(expected.reason_of(difference, {"name": "ceilings 2"}))
        weaker = "ceilings: ceiling.load: weaker"
        self.assertIsNone(expected.reason_of(weaker, {"name": "ceilings 1"}))
        self.assertEqual(expected.unseen(), [])
        Expected(ROOT / "tests/answers/0.2-expected.toml")  # ends the test where it is malformed


class Reading(unittest.TestCase):
    def test_questions_are_the_same_each_time(self):
        first = list(all_questions())
        self.assertEqual(first, list(all_questions()))
        self.assertEqual({asked["kind"] for asked in first}, set(KINDS))

    def test_the_words_of_a_question(self):
        asked = {"verb": "chart", "drive": "...", "form": "nc",
                 "with": {"x": "a=1,2", "proved": True}}
        self.assertEqual(adapter.ask(asked), ["chart", "input.toml", "--x", "a=1,2", "--proved",
                                              "--output", "table.nc"])

    def test_the_limit_of_a_region_is_read_from_its_picture(self):
        drawn = (ROOT / "docs/pictures/camera-head-region.svg").read_text(encoding="utf-8")
        region = picture.limits(drawn)
        self.assertAlmostEqual(region["range"]["x"][0], 7 / 30, delta=1e-3)  # a thirtieth of now
        self.assertAlmostEqual(region["range"]["y"][1], 30 * 220, delta=5)
        (curve,) = region["curves"].values()
        self.assertAlmostEqual(curve[0][0], 210, delta=0.1)  # it leaves at the right
        self.assertGreater(len(curve), 20)

    def test_columns_of_a_table_lose_their_units(self):
        rows = [["time_s", "load_speed_rad_per_s", "mode"], ["0", "1.5", "apart"]]
        self.assertEqual(adapter.table_of_motion(rows)["samples"],
                         {"time": [0.0], "load_speed": [1.5], "mode": ["apart"]})


if __name__ == "__main__":
    unittest.main()
