"""Exceptions, one for each exit code of the command line."""
import re
from typing import Dict, Type


class Error(Exception):
    """Base of all errors of the engine. Its text is the command line's message, with the arguments of
    this module instead of options."""

    exit_code = 1  # what the command line ends with
    where = ""  # the file, parameter or option that it is about; may be empty


class Failed(Error):
    """A failure that is not caused by the input, or out of memory."""


class Usage(Error, ValueError):
    """An argument or parameter is unknown, has the wrong type or is out of range."""

    exit_code = 2


class BadInput(Error, ValueError):
    """A scene, project or dataset cannot be used."""

    exit_code = 4


class NoOpenGl(Error):
    """This machine has no OpenGL driver that can render."""

    exit_code = 5


class CannotWrite(Error):
    """A file or folder cannot be written."""

    exit_code = 6


class Cancelled(Error):
    """The work was cancelled. Ctrl-C raises KeyboardInterrupt instead."""

    exit_code = 130


def failure(kind: Type[Error], message: str, where: str = "") -> Error:
    """Makes an error with the text 'where: message'."""
    error = kind(f"{where}: {message}" if where else message)
    error.where = where
    return error


_KINDS: Dict[int, Type[Error]] = dict(
    enumerate((Failed, Usage, BadInput, NoOpenGl, CannotWrite, Cancelled)))


#: Arguments of this module whose names differ from the command line's options, and options without a
#: value. The others have the option's name with underscores.
_ARGUMENTS = {"--unit": "unit_m", "--up": "up_axis", "--out": "folder", "--time": "time_s",
              "--camera": "cameras", "--set": "", "--threads": "set_threads()",
              **{f"--{name}": f"{name.replace('-', '_')}=True"
                 for name in ("convert", "keep-meshes", "overwrite", "resume", "still")}}
_OPTION = re.compile(r"'dollytrack [^']*'|blender .*|(?<![\w-])(?P<option>--[a-z][a-z-]*)"
                     r"(?:[ =](?P<value>-?\d[\w.]*|-?[xyz]\b|[\w~]+[=:/][^\s;,)]*[\w/]))?")


def in_python(message: str) -> str:
    """A message of the engine with this module's arguments instead of the command line's options."""
    def argument(found: "re.Match[str]") -> str:
        option, value = found["option"], found["value"]
        if option is None:
            return found[0]
        name = _ARGUMENTS.get(option, option[2:].replace("-", "_"))
        if value is None:
            return name or "parameter"
        if option == "--set":
            return value
        number = re.fullmatch(r"-?\d[\d.e-]*", value)
        return f"{name}={value}" if number else f'{name}="{value}"'

    return _OPTION.sub(argument, message)


def error_of(code: int, message: str, where: str) -> Error:
    """Makes the exception for an error of the engine; called by the module _core."""
    return failure(_KINDS[code], in_python(message), in_python(where))
