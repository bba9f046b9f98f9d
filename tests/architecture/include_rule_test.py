#!/usr/bin/env python3
"""The check of the include rule must notice each kind of violation, planted in a tree of its own."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKER = pathlib.Path(__file__).with_name("include_rule.py")


def check(files):
    """Exit status and output of the checker on a tree of these files (path -> text)."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "include" / "gearlash").mkdir(parents=True)
        for path, text in files.items():
            file = root / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        result = subprocess.run(
            [sys.executable, str(CHECKER), folder], capture_output=True, text=True, check=False)
        return result.returncode, result.stdout + result.stderr


class IncludeRule(unittest.TestCase):
    def assert_sound(self, files):
        self.assertEqual(check(files), (0, ""))

    def assert_refused(self, path, text, line=1):
        status, output = check({path: text})
        self.assertEqual(status, 1, output)
        self.assertIn(f"{path}:{line}: ", output)

    def test_a_sound_tree_passes(self):
        self.assert_sound({
            "include/gearlash/servo/shaft.hpp": '#include <vector>\n',
            "include/gearlash/motion/flow.hpp": '#include "gearlash/servo/shaft.hpp"\n',
            "src/motion/flow.cpp": '#include <boost/math/tools/roots.hpp>\n#include "roots.hpp"\n',
            "src/motion/roots.hpp": '#include "gearlash/motion/flow.hpp"\n',
            "src/io/reader.cpp": '#include <fstream>\n#include "gearlash/motion/flow.hpp"\n',
            "include/gearlash/heritage/run.hpp": '#include "gearlash/io/reader.hpp"\n',
        })

    def test_a_layer_may_not_include_one_to_its_right(self):
        self.assert_refused("src/servo/shaft.cpp",
                            '#include <cmath>\n#include "gearlash/motion/flow.hpp"\n', line=2)
        self.assert_refused("include/gearlash/cycle/map.hpp", '#include "gearlash/io/reader.hpp"\n')
        self.assert_refused("src/motion/flow.cpp", '  #  include <gearlash/cycle/map.hpp>\n')

    def test_hybrid_knows_nothing_of_gears(self):
        self.assert_refused("src/hybrid/mode.cpp", '#include "gearlash/servo/shaft.hpp"\n')

    def test_no_layer_uses_heritage(self):
        self.assert_refused("src/io/reader.cpp", '#include "gearlash/heritage/run.hpp"\n')

    def test_numerics_do_not_print_read_or_look_at_clocks(self):
        for header in ("iostream", "cstdio", "fstream", "filesystem", "chrono", "ctime", "time.h"):
            self.assert_refused("src/cycle/map.cpp", f"#include <{header}>\n")

    def test_numerics_do_not_use_the_libraries_of_io(self):
        for header in ("fmt/format.h", "toml++/toml.h", "nlohmann/json.hpp", "udunits2.h"):
            self.assert_refused("src/servo/shaft.cpp", f"#include <{header}>\n")

    def test_public_headers_of_the_numerics_burden_no_user_with_boost(self):
        self.assert_refused("include/gearlash/cycle/map.hpp", "#include <boost/math/tools/roots.hpp>\n")

    def test_numerics_keep_to_what_web_assembly_has(self):
        self.assert_refused("src/drive/controller.cpp", "#include <format>\n")

    def test_no_way_around_through_a_path(self):
        self.assert_refused("src/servo/shaft.cpp", '#include "../cycle/map.hpp"\n')
        status, output = check({"src/servo/shaft.cpp": '#include "../cycle/map.hpp"\n',
                                "src/cycle/map.hpp": ""})
        self.assertEqual(status, 1, output)

    def test_an_unknown_layer_is_refused(self):
        status, output = check({"src/extras/thing.cpp": ""})
        self.assertEqual(status, 1)
        self.assertIn("src/extras", output)

    def test_a_name_that_says_nothing_is_refused(self):
        status, output = check({"src/servo/utils.cpp": ""})
        self.assertEqual(status, 1)
        self.assertIn("src/servo/utils.cpp", output)


if __name__ == "__main__":
    unittest.main()
