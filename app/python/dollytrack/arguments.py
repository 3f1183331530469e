"""Converts callers' arguments for the engine: parameters, paths, lists, progress."""
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
    """A parameter of planning or rendering, as listed by 'dollytrack params'."""

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

#: Sections that affect only images, not the plan: render() and export() accept their parameters.
PICTURE_SECTIONS = ("imu", "stereo", "picture", "light", "sensor")


def assignments(parameters: Dict[str, Any]) -> List[str]:
    """The parameters as 'name=value'; the engine checks them."""
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
    raise failure(Usage, f"A value of the type {type(value).__name__} cannot be used{wanted}.", name)


def takes_parameters(sections: Optional[Iterable[str]] = None) -> Callable[[Any], Any]:
    """Decorator: adds the parameters to the signature and documentation of a method with **parameters."""

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
    """A path as bytes. Raises Usage if it is empty or of another type."""
    try:
        name = os.fsencode(value)
    except TypeError:
        raise failure(Usage, f"A path must be a str or os.PathLike, not {type(value).__name__}.",
                      what) from None
    if not name or b"\0" in name:
        raise failure(Usage, "The path is empty or has a NUL character.", what)
    return name


def words(value: Union[None, str, Iterable[str]], what: str) -> List[str]:
    """A list of str; a single str becomes a list of one."""
    if value is None:
        return []
    listed = [value] if isinstance(value, str) else list(value)
    for one in listed:
        if not isinstance(one, str):
            raise failure(Usage, f"The values must be str, not {type(one).__name__}.", what)
    return listed


def whole(value: Any, what: str, least: int = 0, most: int = 2**31 - 1) -> int:
    """A whole number within the limits."""
    try:
        number = operator.index(value)
    except TypeError:
        raise failure(Usage, f"The value must be a whole number, not {type(value).__name__}.",
                      what) from None
    if not least <= number <= most:
        raise failure(Usage, f"{number} is not in the range {least} .. {most}.", what)
    return number


def reporter(progress: Progress) -> Optional[Callable[[float, str], object]]:
    """The function that the engine calls with a fraction (0 .. 1) and the stage's name."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return _Bar()
    if not callable(progress):
        raise failure(Usage, "Give True, or a function of a fraction and the stage's name.", "progress")
    return progress


class _Bar:
    """A progress bar of tqdm if it is installed, otherwise a line on stderr."""

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
