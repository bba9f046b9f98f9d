#!/usr/bin/env python3
"""Checks that no library offers or asks for a function of Eigen under Eigen's own name.

They are weak symbols, of which the linker keeps one of all there are: a program that compiles its own
Eigen for another vector unit, with another alignment, would share them and corrupt its memory.

Usage: eigen_symbols_test.py LIBRARY...
"""

import re
import subprocess
import sys
import unittest

LIBRARIES = sys.argv[1:]
OF_EIGEN = re.compile(r"(?<!\d)5Eigen\d")  # as names are mangled: N5Eigen6MatrixI...


def symbols(library):
    return subprocess.run(["nm", library], check=True, capture_output=True, text=True).stdout


class EigenIsOurOwn(unittest.TestCase):
    def test_no_symbol_is_eigens(self):
        self.assertTrue(LIBRARIES)
        for library in LIBRARIES:
            found = [line for line in symbols(library).splitlines() if OF_EIGEN.search(line)]
            self.assertEqual(found[:5], [], library)

    def test_it_is_there_under_our_name(self):
        self.assertTrue(any("14gearlash_eigen" in symbols(library) for library in LIBRARIES))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
