#!/usr/bin/env python3
"""The check of the include rule must notice each kind of fault, planted in a tree of its own."""

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
        (root / "src").mkdir(parents=True)
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
            "include/gearlash/drive.hpp": '#include <vector>\n',
            "include/gearlash/answer.hpp": '#include "gearlash/drive.hpp"\n',
            "src/closed_form/flow.cpp": '#include <boost/math/tools/roots.hpp>\n'
                                        '#include "closed_form/roots.hpp"\n'
                                        '#include "model/shaft.hpp"\n'
                                        '#include <gearlash/drive.hpp>\n',
            "src/question/axis.hpp": '#include "closed_form/lanes/batch.hpp"\n',
            "src/input/reader.cpp": '#include <fstream>\n#include "model/shaft.hpp"\n',
            "src/thesis/run.hpp": '#include "input/reader.hpp"\n',
        })

    def test_a_room_may_not_include_a_later_one(self):
        self.assert_refused("src/model/shaft.cpp",
                            '#include <cmath>\n#include "closed_form/flow.hpp"\n', line=2)
        self.assert_refused("src/question/map/map.hpp", '#include "input/reader.hpp"\n')
        self.assert_refused("src/base/root.cpp", '  #  include <closed_form/flow.hpp>\n')

    def test_a_face_includes_public_headers_and_what_is_listed(self):
        self.assert_refused("apps/tool/verb.cpp",
                            '#include "gearlash/drive.hpp"\n#include "question/axis.hpp"\n', line=2)
        self.assert_refused("web/core/core.cpp", '#include "question/axis.hpp"\n')
        listed = "tests/architecture/inner_headers_of_faces.txt"
        self.assert_sound({"apps/tool/verb.cpp": '#include "question/axis.hpp"\n#include "verb.hpp"\n',
                           "apps/tool/thesis_verb.cpp": '#include "thesis/printout.hpp"\n',
                           listed: "apps question/axis.hpp\n"})
        status, output = check({listed: "apps question/axis.hpp\n"})
        self.assertEqual(status, 1)
        self.assertIn("no longer needed: apps question/axis.hpp", output)

    def test_hybrid_knows_nothing_of_gears(self):
        self.assert_refused("src/hybrid/mode.cpp", '#include "model/shaft.hpp"\n')

    def test_the_two_engines_do_not_know_each_other(self):
        self.assert_refused("src/general/assemble/mode.cpp", '#include "closed_form/flow.hpp"\n')
        self.assert_refused("src/closed_form/flow.cpp", '#include "general/assemble/mode.hpp"\n')

    def test_no_room_uses_thesis(self):
        self.assert_refused("src/picture/curve.cpp", '#include "thesis/run.hpp"\n')

    def test_numerics_do_not_print_read_or_look_at_clocks(self):
        for header in ("iostream", "cstdio", "fstream", "filesystem", "chrono", "ctime", "time.h"):
            self.assert_refused("src/closed_form/map.cpp", f"#include <{header}>\n")

    def test_numerics_do_not_use_the_libraries_of_files(self):
        for header in ("fmt/format.h", "toml++/toml.h", "nlohmann/json.hpp", "udunits2.h"):
            self.assert_refused("src/model/shaft.cpp", f"#include <{header}>\n")

    def test_decompositions_are_compiled_in_numeric_alone(self):
        for header in ("Eigen/LU", "Eigen/Dense", "unsupported/Eigen/MatrixFunctions"):
            self.assert_refused("src/hybrid/orbit.cpp", f"#include <{header}>\n")
            self.assert_sound({"src/numeric/solve.cpp": f"#include <{header}>\n"})
        self.assert_sound({"src/hybrid/orbit.cpp": "#include <Eigen/Core>\n"})

    def test_public_headers_burden_no_user_with_a_library_or_a_room(self):
        for header in ("<Eigen/Core>", "<boost/math/tools/roots.hpp>", '"base/extent.hpp"'):
            self.assert_refused("include/gearlash/answer.hpp", f"#include {header}\n")

    def test_numerics_keep_to_what_web_assembly_has(self):
        self.assert_refused("src/model/controller.cpp", "#include <format>\n")

    def test_no_way_around_through_a_path(self):
        self.assert_refused("src/base/root.cpp", '#include "../closed_form/map.hpp"\n')
        self.assert_refused("src/base/root.cpp", '#include "bounds.hpp"\n')

    def test_an_unknown_room_is_refused(self):
        status, output = check({"src/extras/thing.cpp": ""})
        self.assertEqual(status, 1)
        self.assertIn("src/extras", output)

    def test_a_name_that_says_nothing_is_refused(self):
        status, output = check({"src/base/utils.cpp": ""})
        self.assertEqual(status, 1)
        self.assertIn("src/base/utils.cpp", output)


if __name__ == "__main__":
    unittest.main()
