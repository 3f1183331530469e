#!/usr/bin/python3
"""Tasks of users in the editor's real window, with a real mouse and keyboard.

Usage: tasks_test.py EDITOR COMMAND_LINE [unittest arguments]
"""
import sys
import unittest

from task import Programs

Programs.editor = sys.argv.pop(1)
Programs.command_line = sys.argv.pop(1)

from edit_tasks import ByHand  # noqa: E402,F401
from export_tasks import Exporting  # noqa: E402,F401
from file_tasks import Files  # noqa: E402,F401
from following_tasks import Following  # noqa: E402,F401
from moving_tasks import Moving  # noqa: E402,F401
from opening_tasks import Opening  # noqa: E402,F401
from scene_tasks import Looking, Selecting, Timeline  # noqa: E402,F401
from tuning_tasks import Tuning  # noqa: E402,F401
from window_tasks import Window  # noqa: E402,F401

if __name__ == "__main__":
    unittest.main(verbosity=2)
