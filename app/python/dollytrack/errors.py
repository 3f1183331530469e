"""Exceptions, one for each exit code of the command line."""
from typing import Dict, Type


class Error(Exception):
    """Base of all errors of the engine. Its text is the command line's message."""

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


def error_of(code: int, message: str, where: str) -> Error:
    """Makes the exception for an error of the engine; called by the module _core."""
    return failure(_KINDS[code], message, where)
