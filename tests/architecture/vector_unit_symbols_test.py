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


def symbols(object_file, *options):
    return subprocess.run(["nm", "--defined-only", *options, object_file], check=True,
                          capture_output=True, text=True).stdout


def functions_offered(object_file):
    """Demangled names of the functions that the linker may merge or call from elsewhere."""
    for line in symbols(object_file, "--demangle").splitlines():
        match = re.match(r"[0-9a-f]+ ([TWi]) (.*)", line)
        if match:
            yield match.group(2)


class KernelsKeepToThemselves(unittest.TestCase):
    def test_every_function_names_its_vector_unit(self):
        for unit in WIDER_UNITS:
            names = [f"cycle_kernel_{unit}.cpp.o", f"cycle_kernel_{unit}.cpp.obj"]
            found = [one for one in OBJECTS if one.name in names]
            self.assertEqual(len(found), 1, f"the kernel of {unit} among {OBJECTS}")
            functions = list(functions_offered(found[0]))
            self.assertTrue(functions, f"{found[0].name} offers no function")
            for function in functions:
                self.assertIn(unit, function, f"{found[0].name}: {function} may be called on a "
                                              f"processor without {unit}")

    def test_nothing_runs_before_the_unit_is_chosen(self):
        for object_file in OBJECTS:
            if "cycle_kernel" in object_file.name:
                self.assertNotIn("_GLOBAL__sub_I", symbols(object_file), object_file.name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
