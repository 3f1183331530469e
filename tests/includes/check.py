#!/usr/bin/env python3
"""Checks that source files include only what the design allows. Usage: check.py ROOT

layers.txt tells which folder may include which. Libraries stay inside the folders that own them, and
files of any origin are opened only by the functions that guard against pipes, links and sizes.
"""

import pathlib
import re
import sys

# A library's headers, and the folders that may include them. Dear ImGui 1.86 hands the numbers of
# the keys through from GLFW, so ui needs these.
LIBRARIES = [
    ("imgui", "ui app"),
    ("GLFW/", "ui app"),
    ("GL/", "render"),
    ("assimp/", "engine"),
    ("octomap/", "planning"),
    ("embree", "engine"),
    ("hdf5", "engine"),
]

# A call, and the only files that may contain it. Files below /proc are the system's own.
CALLS = [
    (r"[jJ]son::parse\(", "engine/io/files/bounded_json.cpp"),
    (r"json::accept\(", ""),
    (r"toml::parse\(", "app/batch/jobs_file.cpp"),
    (r"ifstream", "app/editor/files/owner_mark.cpp engine/io/sandbox/processor_wait.cpp"),
    (r"fopen\(", ""),
    (r"cv::imread\(", ""),
]


def read_layers(text):
    """The headings with the headings they may include, and for each folder its heading and line."""
    uses, place = {}, {}
    heading = None
    for number, line in enumerate(text.splitlines()):
        line = line.split("#")[0].rstrip()
        if not line:
            continue
        if not line.startswith(" "):
            heading, _, rest = line.partition(":")
            uses[heading] = rest.split()
            continue
        for name in line.split():
            folder = heading if name == "." else f"{heading}/{name}"
            if folder in place:
                raise SystemExit(f"layers.txt: {folder} stands twice")
            place[folder] = (heading, number)
    return uses, place


def may_include(source, target, uses, place):
    source_heading, source_line = place[source]
    target_heading, target_line = place[target]
    if source_heading != target_heading:
        return target_heading in uses[source_heading]
    return source == target or target_line < source_line


def problems(root, layers):
    uses, place = read_layers(layers)
    for heading in uses:
        for path in sorted((root / heading).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            name = path.relative_to(root).as_posix()
            folder = path.parent.relative_to(root).as_posix()
            if folder not in place:
                yield f"{name}: {folder} is not in layers.txt"
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                where = f"{name}:{number}"
                if found := re.match(r'#include "([^"]+)"', line):
                    target = found[1].rpartition("/")[0]
                    if target not in place:
                        yield f"{where}: {target or found[1]} is not in layers.txt"
                    elif not may_include(folder, target, uses, place):
                        yield f"{where}: {folder} may not include {target}"
                for header, owners in LIBRARIES:
                    if line.startswith(f"#include <{header}") and heading not in owners.split():
                        yield f"{where}: <{header}> belongs to {owners}"
                for call, files in CALLS:
                    if re.match(f"[^/]*{call}", line) and name not in files.split():
                        yield (f"{where}: files are opened by engine/io/files/input_file.h, and "
                               "JSON is parsed by engine/io/files/bounded_json.h")


def main():
    root = pathlib.Path(sys.argv[1])
    layers = pathlib.Path(__file__).with_name("layers.txt").read_text(encoding="utf-8")
    found = list(problems(root, layers))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
