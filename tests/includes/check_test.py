#!/usr/bin/env python3
"""The include check finds what it is for, and nothing else, in small trees of files."""

import pathlib
import tempfile
import unittest

import check

LAYERS = """
low:
  .
  core math
  io/files
high: low
  panels  # a remark
"""
# A file for each folder of the table, so that none is without.
FILES = {"low/root.h": "", "low/core/z.h": "", "low/math/z.h": "", "low/io/files/z.h": "",
         "high/panels/z.h": ""}


class Check(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (FILES | files).items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text + "\n", encoding="utf-8")
            return list(check.problems(root, LAYERS))

    def test_includes_of_lower_folders_are_allowed(self):
        self.assertEqual([], self.found({
            "low/core/a.h": '#include "low/core/b.h"\n#include "low/root.h"',
            "low/io/files/c.cpp": '#include "low/core/a.h"\n#include <vector>',
            "high/panels/d.cpp": '#include "low/io/files/c.h"'}))

    def test_an_include_of_a_higher_folder_is_found(self):
        self.assertEqual(["low/core/a.h:1: low/core may not include low/io/files"],
                         self.found({"low/core/a.h": '#include "low/io/files/c.h"'}))

    def test_an_include_of_a_folder_on_the_same_line_is_found(self):
        self.assertEqual(["low/core/a.h:2: low/core may not include low/math"],
                         self.found({"low/core/a.h": '\n#include "low/math/c.h"'}))

    def test_an_include_of_a_higher_heading_is_found(self):
        self.assertEqual(["low/io/files/a.h:1: low/io/files may not include high/panels"],
                         self.found({"low/io/files/a.h": '#include "high/panels/c.h"'}))

    def test_a_folder_that_the_table_lacks_is_found(self):
        self.assertCountEqual(["low/new/a.h: low/new is not in layers.txt",
                               "low/core/b.h:1: low/newer is not in layers.txt"],
                              self.found({"low/new/a.h": "",
                                          "low/core/b.h": '#  include <low/newer/c.h>'}))

    def test_a_folder_without_files_and_a_missing_heading_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("low: there is no such folder",
                          list(check.problems(pathlib.Path(folder), LAYERS)))
        with self.assertRaises(SystemExit):
            check.read_layers("low:\n  core\n  core\n")

    def test_a_library_outside_its_folder_is_found(self):
        self.assertEqual(["low/core/a.cpp:1: <imgui.h> belongs to ui app"],
                         self.found({"low/core/a.cpp": "#include <imgui.h>"}))

    def test_an_unguarded_call_is_found_and_a_comment_is_not(self):
        found = self.found({"low/core/a.cpp": 'auto card = json::parse(read(folder / "a.json"));',
                            "low/core/b.cpp": "// nlohmann::json::parse(text)"})
        self.assertEqual(1, len(found))
        self.assertIn("bounded_json.h", found[0])


if __name__ == "__main__":
    unittest.main()
