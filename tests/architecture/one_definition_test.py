#!/usr/bin/env python3
"""The check of the one-definition rule must notice what no linker does, and nothing else."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import one_definition  # noqa: E402


def check(**files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            stem, _, suffix = name.rpartition("_")
            path = pathlib.Path(folder) / "src" / f"{stem}.{suffix}"
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return list(one_definition.faults(pathlib.Path(folder)))


class OneDefinition(unittest.TestCase):
    def test_a_class_of_one_name_in_two_files(self):
        for kind in ("struct", "class", "union", "enum class", "struct [[nodiscard]]"):
            found = check(a_cpp=f"namespace g::cli {{\n{kind} Plot {{ int a; }};\n}}\n",
                          b_cpp=f"namespace g {{ namespace cli {{ {kind} Plot {{}}; }} }}\n")
            self.assertEqual(len(found), 1, kind)
            self.assertIn("src/a.cpp:2: g::cli::Plot", found[0])

    def test_a_class_of_a_header_again_in_a_file(self):
        self.assertTrue(check(a_hpp="namespace g { struct Plot : Base { int a; }; }",
                              b_cpp="namespace g { struct Plot final { long a; }; }"))

    def test_inline_functions_and_templates(self):
        for head in ("inline", "constexpr", "template <class T>"):
            text = f"namespace g {{ {head} int twice(int x) {{ return 2 * x; }} }}"
            self.assertTrue(check(a_cpp=text, b_cpp=text), head)

    def test_what_only_its_file_sees(self):
        text = "namespace g { namespace { struct Plot { int a; }; } }"
        self.assertFalse(check(a_cpp=text, b_cpp=text))

    def test_other_names_members_and_texts(self):
        self.assertFalse(check(
            a_cpp="namespace g { struct A { struct Part {}; }; }",
            b_cpp='namespace g { struct B { struct Part {}; }; const char* t = "struct A {"; '
                  "// struct A {\n struct A; void f(A a) { struct A {}; } }",
            c_cpp="namespace h { struct A {}; }"))


if __name__ == "__main__":
    unittest.main()
