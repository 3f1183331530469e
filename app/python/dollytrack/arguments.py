"""What a caller gives, made into what the engine takes: parameters, paths, lists, progress."""
import inspect
import operator
import os
import sys
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Tuple, Union

from . import _core
from .errors import Usage, failure

Path = Union[str, "os.PathLike[str]"]
Value = Union[bool, int, float, str]
Progress = Union[None, bool, Callable[[float, str], object]]


class Parameter(NamedTuple):
    """One parameter of planning and pictures, as 'dollytrack params' lists it."""

    section: str
    name: str
    type: type
    default: Value
    unit: str
    range: str
    text: str
    choices: Tuple[str, ...]


def _listed() -> Dict[str, Parameter]:
    types: Dict[str, type] = {"bool": bool, "int": int, "float": float, "str": str}
    return {row[1]: Parameter(row[0], row[1], types[row[2]], *row[3:7], tuple(row[7]))
            for row in _core.parameters()}


#: All parameters by name, in the order of their sections.
PARAMETERS = _listed()

#: Those that shape no plan, only pictures: render() and export() take them.
PICTURE_SECTIONS = ("imu", "stereo", "picture", "light", "sensor")


def assignments(parameters: Dict[str, Any]) -> List[str]:
    """As 'name=value', which the engine checks."""
    return [f"{name}={_text(name, value)}" for name, value in parameters.items()]


def _text(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):
        return "true" if value else "false"
    try:
        return str(operator.index(value))
    except TypeError:
        pass
    try:
        return repr(float(value))
    except (TypeError, ValueError):
        pass
    known = PARAMETERS.get(name)
    wanted = f"; it must be {known.range}" if known else ""
    raise failure(Usage, f"A {type(value).__name__} cannot be used{wanted}.", name)


def takes_parameters(sections: Optional[Iterable[str]] = None) -> Callable[[Any], Any]:
    """Gives a method with **parameters the signature and the documentation of the parameters."""

    def describe(function: Any) -> Any:
        chosen = [p for p in PARAMETERS.values() if sections is None or p.section in sections]
        signature = inspect.signature(function)
        fixed = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        named = [inspect.Parameter(p.name, inspect.Parameter.KEYWORD_ONLY, default=p.default,
                                   annotation=p.type) for p in chosen]
        function.__signature__ = signature.replace(parameters=fixed + named)
        lines = [inspect.cleandoc(function.__doc__ or ""), "", "Parameters"]
        section = ""
        for p in chosen:
            if p.section != section:
                section = p.section
                lines.append(f"  {section}")
            unit = f" {p.unit}" if p.unit else ""
            lines.append(f"    {p.name}: {p.type.__name__} = {p.default!r}  ({p.range}{unit})")
            lines.append(f"        {p.text}")
        function.__doc__ = "\n".join(lines)
        return function

    return describe


def path(value: Path, what: str) -> bytes:
    """A file's name in bytes; empty ones and others are refused."""
    try:
        name = os.fsencode(value)
    except TypeError:
        raise failure(Usage, f"A path is a str or os.PathLike, not {type(value).__name__}.",
                      what) from None
    if not name or b"\0" in name:
        raise failure(Usage, "The name is empty or has a NUL character.", what)
    return name


def words(value: Union[None, str, Iterable[str]], what: str) -> List[str]:
    """A list of str; one str is a list of one."""
    if value is None:
        return []
    listed = [value] if isinstance(value, str) else list(value)
    for one in listed:
        if not isinstance(one, str):
            raise failure(Usage, f"Give texts (str), not {type(one).__name__}.", what)
    return listed


def whole(value: Any, what: str, least: int = 0, most: int = 2**31 - 1) -> int:
    """A whole number within the limits."""
    try:
        number = operator.index(value)
    except TypeError:
        raise failure(Usage, f"Give a whole number, not {type(value).__name__}.", what) from None
    if not least <= number <= most:
        raise failure(Usage, f"{number} is not within {least} .. {most}.", what)
    return number


def reporter(progress: Progress) -> Optional[Callable[[float, str], object]]:
    """What the engine calls with a fraction (0 .. 1) and the name of a stage."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return _Bar()
    if not callable(progress):
        raise failure(Usage, "Give True, or a function of a fraction and a stage.", "progress")
    return progress


class _Bar:
    """A bar of tqdm where that is installed, else a line on stderr."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self.bar: Any = None
        else:
            self.bar = tqdm(total=100, unit="%", bar_format="{desc}: {percentage:3.0f}%|{bar}| "
                                                            "{elapsed}<{remaining}")

    def __call__(self, fraction: float, stage: str) -> None:
        if self.bar is None:
            sys.stderr.write(f"\r{stage:20} {100 * fraction:3.0f} %")
            sys.stderr.flush()
            return
        self.bar.set_description(stage, refresh=False)
        self.bar.n = round(100 * fraction)
        self.bar.refresh()

    def __del__(self) -> None:
        if self.bar is not None:
            self.bar.close()
        else:
            sys.stderr.write("\n")
