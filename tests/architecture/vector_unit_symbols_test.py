#!/usr/bin/env python3
"""Checks that the kernels of wider vector units share no function with the rest of the program.

An inline function of plain doubles is compiled once in every file that uses it and the linker keeps
one of the copies, perhaps the one with AVX instructions, which stops a program on a processor that
has none. Every function that such a file offers to the linker must therefore name its vector unit.

Usage: vector_unit_symbols_test.py OBJECT...       the object files of the layer chart
"""

import pathlib
import re
import subprocess
import sys
import unittest

WIDER_UNITS = ("avx2", "avx512")
OBJECTS = [pathlib.Path(argument) for argument in sys.argv[1:]]


def functions_offered(object_file):
    """Demangled names of the functions that the linker may merge or call from elsewhere."""
    listing = subprocess.run(["nm", "--demangle", "--defined-only", object_file], check=True,
                             capture_output=True, text=True).stdout
    for line in listing.splitlines():
        match = re.match(r"[0-9a-f]+ ([TWi]) (.*)", line)
        if match:
            yield match.group(2)


class KernelsKeepToThemselves(unittest.TestCase):
    def test_every_function_names_its_vector_unit(self):
        checked = 0
        for unit in WIDER_UNITS:
            for object_file in OBJECTS:
                if object_file.name != f"cycle_kernel_{unit}.cpp.o":
                    continue
                for function in functions_offered(object_file):
                    checked += 1
                    self.assertIn(unit, function, f"{object_file.name}: {function} may be called on "
                                                  f"a processor without {unit}")
        self.assertGreater(checked, len(WIDER_UNITS), "no kernel was looked at")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
