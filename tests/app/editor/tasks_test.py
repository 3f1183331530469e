#!/usr/bin/python3
"""Tasks of users in the editor's real window, with a real mouse and keyboard.

Usage: tasks_test.py EDITOR COMMAND_LINE [unittest arguments, such as tuning_tasks or
       tuning_tasks.Tuning.test_type_a_value; all tasks where none is named]
"""
import pathlib
import sys
import unittest

from task import Programs

Programs.editor = sys.argv.pop(1)
Programs.command_line = sys.argv.pop(1)

if __name__ == "__main__":
    if not any(argument.endswith("_tasks") or "_tasks." in argument for argument in sys.argv[1:]):
        folder = pathlib.Path(__file__).resolve().parent
        sys.argv += sorted(path.stem for path in folder.glob("*_tasks.py"))
    unittest.main(module=None, verbosity=2)
