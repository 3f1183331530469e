"""Writes dollytrack/_parameter_types.pyi: the parameters of each section with their types, from the
list in the built extension. Type checkers and editors use it to check and complete keyword arguments.

Usage: write_parameter_types.py FOLDER_WITH_THE_EXTENSION
"""
import pathlib
import sys
import textwrap

TYPES = {"bool": "bool", "int": "SupportsIndex", "float": "SupportsFloat", "str": "str"}


def type_of(kind, choices):
    return f"Literal[{', '.join(map(repr, choices))}]" if choices else TYPES[kind]


def stub_of(rows):
    sections = {}
    for section, name, kind, default, unit, limits, text, choices, only_with in rows:
        within = "" if choices or kind == "bool" else f"; range: {limits}"
        needs = f"; only with {only_with}" if only_with else ""
        about = f"{text}. Default: {default!r}{' ' + unit if unit else ''}{within}{needs}."
        lines = textwrap.wrap(about, 90)
        sections.setdefault(section, []).append(
            f"    {name}: {type_of(kind, choices)}\n    \"\"\"" + "\n    ".join(lines) + "\"\"\"\n")
    text = ("from typing import Literal, SupportsFloat, SupportsIndex\n"
            "from typing_extensions import TypedDict\n")
    for section, fields in sections.items():
        text += f"\nclass {class_name(section)}(TypedDict, total=False):\n" + "".join(fields)
    return text + "\nclass All(" + ", ".join(map(class_name, sections)) + ", total=False): ...\n"


def class_name(section):
    return "".join(word.capitalize() for word in section.split("_"))


if __name__ == "__main__":
    sys.path.insert(0, sys.argv[1])
    import _core

    pathlib.Path(sys.argv[1], "_parameter_types.pyi").write_text(stub_of(_core.parameters()))
