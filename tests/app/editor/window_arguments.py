"""Command line arguments of the tests that need a window and both programs."""
import argparse
import sys
from unittest import SkipTest

from screen import need_window
from task import Programs


def read(description):
    """Reads the arguments and stores the programs' paths; ends the test where no window can be
    opened."""
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("editor")
    parser.add_argument("command_line")
    parser.add_argument("--long", action="store_true", help="many more rounds")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    try:
        need_window()
    except SkipTest:
        sys.exit(0)
    Programs.editor = arguments.editor
    Programs.command_line = arguments.command_line
    return arguments
