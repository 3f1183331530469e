"""What can go wrong, named as the exit codes of the command line are."""
from typing import Dict, Type


class Error(Exception):
    """Base of all errors of the engine. Its text is the sentence that the command line prints."""

    exit_code = 1  # what the command line ends with
    where = ""  # the file, parameter or option that it is about; may be empty


class Failed(Error):
    """Something failed that is nobody's input, or memory ran out."""


class Usage(Error, ValueError):
    """An argument or parameter is unknown, of the wrong kind or out of range."""

    exit_code = 2


class BadInput(Error, ValueError):
    """A scene, project or dataset cannot be used."""

    exit_code = 4


class NoOpenGl(Error):
    """Nothing on this machine can draw."""

    exit_code = 5


class CannotWrite(Error):
    """A file or folder cannot be written."""

    exit_code = 6


class Cancelled(Error):
    """The work was stopped. After Ctrl-C it is KeyboardInterrupt that is raised."""

    exit_code = 130


def failure(kind: Type[Error], message: str, where: str = "") -> Error:
    """An error that reads 'where: message'."""
    error = kind(f"{where}: {message}" if where else message)
    error.where = where
    return error


_KINDS: Dict[int, Type[Error]] = dict(
    enumerate((Failed, Usage, BadInput, NoOpenGl, CannotWrite, Cancelled)))


def error_of(code: int, message: str, where: str) -> Error:
    """The exception for an error of the engine; for the module _core."""
    return failure(_KINDS[code], message, where)
