#!/usr/bin/env python3
"""Checks that source files include only what the design allows. Usage: check.py ROOT

layers.txt tells which folder may include which. Libraries stay inside the folders that own them, and
files of any origin are opened only by the functions that guard against pipes, links and sizes.
"""

import pathlib
import re
import sys

# The beginning of a library's headers, and the folders that may include them. Dear ImGui 1.86 uses
# GLFW's key codes, so ui includes GLFW, too.
LIBRARIES = [
    ("imgui", "ui app"),
    ("GLFW/", "ui app"),
    ("GL/", "render"),
    ("assimp/", "engine/io/assimp engine/io/sandbox"),
    ("octomap/", "planning/free_space"),
    ("embree", "engine/geometry"),
    ("hdf5", "engine/io/hdf5"),
    ("libav", "render/formats/media"),
    # Each would load 100 libraries at every start.
    ("opencv2/imgcodecs", ""),
    ("opencv2/videoio", ""),
    ("pugixml", "engine/io/gazebo engine/io/homes"),
]

# A call, and the only files that may contain it. The two files with ifstream read below /proc.
CALLS = [
    (r"[jJ]son::(parse|sax_parse|accept|from_\w+)\(", "engine/io/files/bounded_json.cpp"),
    (r"toml::parse(_file)?\(", "app/batch/jobs_file.cpp"),
    (r"\bi?fstream\b(?!>)|\bfilebuf\b",
     "app/editor/files/owner_mark.cpp engine/io/sandbox/processor_wait.cpp"),
    (r"\bfopen\(", ""),
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
    met = set()
    for heading in uses:
        if not (root / heading).is_dir():
            yield f"{heading}: there is no such folder"
        for path in sorted((root / heading).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            name = path.relative_to(root).as_posix()
            folder = path.parent.relative_to(root).as_posix()
            if folder not in place:
                yield f"{name}: {folder} is not in layers.txt"
                continue
            met.add(folder)
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                for problem in problems_of(line, name, folder, uses, place):
                    yield f"{name}:{number}: {problem}"
    for folder in place:
        if folder not in met:
            yield f"layers.txt: {folder} has no source files"


def problems_of(line, name, folder, uses, place):
    """The problems of one line of the file `name` in a folder of the table."""
    include = re.match(r'\s*#\s*include\s*(["<])([^">]+)[">]', line)
    if include and (include[1] == '"' or include[2].split("/")[0] in uses):
        target = include[2].rpartition("/")[0]
        if target not in place:
            yield f"{target or include[2]} is not in layers.txt"
        elif not may_include(folder, target, uses, place):
            yield f"{folder} may not include {target}"
    elif include:
        for header, owners in LIBRARIES:
            if include[2].startswith(header) and not any(
                    f"{folder}/".startswith(f"{owner}/") for owner in owners.split()):
                yield f"<{include[2]}> belongs to {owners}"
    for call, files in CALLS:
        if not include and (found := re.search(call, line.split("//")[0])):
            if name not in files.split():
                yield (f"{found[0]} is not allowed here: files are opened by "
                       "engine/io/files/input_file.h, JSON is parsed by "
                       "engine/io/files/bounded_json.h")


def main():
    root = pathlib.Path(sys.argv[1])
    layers = pathlib.Path(__file__).with_name("layers.txt").read_text(encoding="utf-8")
    found = list(problems(root, layers))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
