"""The table of units against the same definitions in 60 digits."""

import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

import mpmath

ROOT = pathlib.Path(__file__).resolve().parents[2]
mpmath.mp.dps = 60


def unit_table():
    """A module of its own at each call."""
    loader = importlib.machinery.SourceFileLoader("unit_table", str(ROOT / "scripts/unit-table"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def all_units(module, database):
    units = module.Database()
    units.read(database)
    module.read_aliases(units, ROOT / "src/input/units_of_engineers.txt")
    return {**{("name", k): u for k, u in units.names.items()},
            **{("symbol", k): u for k, u in units.symbols.items()}}


def many_digits(text):
    # The database has 31 digits of pi.
    return +mpmath.pi if text.startswith("3.14159265") else mpmath.mpf(text)


class UnitTable(unittest.TestCase):
    def test_no_factor_is_off_by_four_roundings(self):
        rounded = all_units(unit_table(), DATABASE)
        module = unit_table()
        module.float = many_digits
        exact = all_units(module, DATABASE)
        self.assertGreater(len(rounded), 800)
        for word, unit in rounded.items():
            if unit is None:
                continue
            error = abs(mpmath.mpf(unit.factor) / exact[word].factor - 1)
            self.assertLess(error, 4 * mpmath.mpf(2) ** -53, word)


if __name__ == "__main__":
    DATABASE = pathlib.Path(sys.argv.pop(1))
    unittest.main()
