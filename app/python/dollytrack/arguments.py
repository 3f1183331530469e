"""Converts callers' arguments for the engine: parameters, paths, lists, progress."""
import difflib
import functools
import inspect
import logging
import operator
import os
import sys
import textwrap
import weakref
from contextlib import contextmanager, nullcontext
from typing import (TYPE_CHECKING, Any, Callable, ContextManager, Dict, Iterable, Iterator, List,
                    Literal, Mapping, NamedTuple, Optional, Sequence, Tuple, TypeVar, Union)

from . import _core
from .errors import Error, Usage, failure, in_python

Path = Union[str, "os.PathLike[str]"]
Value = Union[bool, int, float, str]
_Function = TypeVar("_Function", bound=Callable[..., Any])
Progress = Union[None, bool, Callable[[float, str], object]]
#: OpenGL backends.
OpenGl = Literal["auto", "egl", "osmesa"]


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
    only_with: str  # what it needs to have an effect, such as "max_frames>0"; empty: nothing


class Parameters(Dict[str, Parameter]):
    """Parameters by name. Shown as a table in notebooks and by print()."""

    def __repr__(self) -> str:
        lines: List[str] = []
        section = ""
        for p in self.values():
            if p.section != section:
                section = p.section
                lines.append(section)
            lines.extend(_described(p))
        return "\n".join(lines) or "No parameters."


def _described(p: Parameter, indent: str = "  ") -> List[str]:
    unit = f" {p.unit}" if p.unit else ""
    needs = f"; only with {p.only_with}" if p.only_with else ""
    return [f"{indent}{p.name}: {p.type.__name__} = {p.default!r}  ({p.range}{unit}{needs})",
            *textwrap.wrap(p.text, 96, initial_indent=indent + "    ",
                           subsequent_indent=indent + "    ")]


def _listed() -> Parameters:
    types: Dict[str, type] = {"bool": bool, "int": int, "float": float, "str": str}
    return Parameters({row[1]: Parameter(row[0], row[1], types[row[2]], *row[3:7], tuple(row[7]), row[8])
                       for row in _core.parameters()})


#: All parameters by name, in the order of their sections.
PARAMETERS = _listed()


def parameters(search: str = "") -> Parameters:
    """The parameters whose section, name or description contains a text; all of them by default.

    In a notebook, dt.parameters("frame") shows them as a table; dt.parameters()["fill"].default is a
    value of it. Scene.plan() accepts all of them, other methods those of their sections (see help()).
    """
    if not isinstance(search, str):
        raise failure(Usage, f"The text must be a str, not {type(search).__name__}.", "search")
    text = search.lower()
    return Parameters({name: p for name, p in PARAMETERS.items()
                       if text in p.section or text in name.lower() or text in p.text.lower()})


#: Sections that affect only images, not the plan: render() and export() accept their parameters.
PICTURE_SECTIONS = ("imu", "stereo", "picture", "light", "sensor")
#: Sections that describe the camera and where it may be: judge() accepts their parameters.
JUDGE_SECTIONS = ("body", "camera", "free_space")

if TYPE_CHECKING:  # the parameters that the methods accept, as type checkers know them
    from . import _parameter_types as types

    PlanParameters = types.All

    class PictureParameters(types.Imu, types.Stereo, types.Picture, types.Light, types.Sensor,
                            total=False):
        pass

    class JudgeParameters(types.Body, types.Camera, types.FreeSpace, total=False):
        pass


def assignments(parameters: Mapping[str, object]) -> List[str]:
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


class _ShortSignature(inspect.Signature):
    """A signature with all parameters, for completion in notebooks, that help() shows without them."""

    __slots__ = ()

    def _short(self) -> inspect.Signature:
        shown = [p for p in self.parameters.values() if p.name not in PARAMETERS]
        rest = inspect.Parameter("parameters", inspect.Parameter.VAR_KEYWORD, annotation="Value")
        return inspect.Signature([*shown, rest], return_annotation=self.return_annotation)

    def __str__(self) -> str:
        return str(self._short())

    def format(self, **options: Any) -> str:
        """As help() of Python 3.13 shows it."""
        text: str = getattr(self._short(), "format")(**options)
        return text


#: Other programs' names of parameters.
_SYNONYMS = {"fps": "frame_rate", "fov": "hfov_deg"}


def nearest(name: str, known: Iterable[str], synonyms: Mapping[str, str] = _SYNONYMS) -> str:
    """The known name that a wrong one probably means; empty if none is near."""
    listed = list(known)
    meant = synonyms.get(name.lower(), "")
    close = [meant] if meant in listed else difflib.get_close_matches(name.lower(), listed, 1)
    return close[0] if close else ""


def _unknown(name: str, method: str, fixed: Sequence[inspect.Parameter], chosen: Iterable[str],
             others: str) -> Error:
    """The error for a keyword that a method does not take; others: about other parameters."""
    if name in PARAMETERS:
        return failure(Usage, others, name)
    if any(p.name == name and p.kind is p.VAR_POSITIONAL for p in fixed):
        return failure(Usage, f"Pass the values without a name: {method}('...', '...').", name)
    known = [p.name for p in fixed if p.kind is not p.VAR_POSITIONAL and p.name != "self"]
    meant = nearest(name, [*known, *chosen])
    hint = f"; did you mean '{meant}'?"
    if not meant:
        elsewhere = nearest(name, PARAMETERS)
        hint = (f"; did you mean '{elsewhere}'? {others}" if elsewhere
                else "; dollytrack.parameters() lists all.")
    return failure(Usage, f"There is no parameter '{name}'{hint}")


def takes_parameters(often_used: Iterable[str], sections: Optional[Sequence[str]] = None,
                     others: str = "", instead: Mapping[str, str] = {}
                     ) -> Callable[[_Function], _Function]:
    """Decorator: adds the parameters to the signature of a method with **parameters, and those that
    are often used to its documentation. The method then raises Usage for all other keywords.

    sections: those whose parameters the method takes; None: all.
    others: the message for parameters of other sections; instead: messages for single names.
    """

    def describe(wrapped: Any) -> Any:
        @functools.wraps(wrapped)
        def function(*given: Any, **named: Any) -> Any:
            for name in named:
                if name not in accepted:
                    if name in instead:
                        raise failure(Usage, instead[name], name)
                    raise _unknown(name, wrapped.__name__, fixed, [p.name for p in chosen], others)
            return wrapped(*given, **named)

        chosen = [p for p in PARAMETERS.values() if sections is None or p.section in sections]
        signature = inspect.signature(wrapped)
        fixed = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        accepted = {p.name for p in fixed if p.kind is not p.VAR_POSITIONAL}
        accepted |= {p.name for p in chosen}
        added = [inspect.Parameter(p.name, inspect.Parameter.KEYWORD_ONLY, default=p.default,
                                   annotation=p.type) for p in chosen]
        function.__signature__ = _ShortSignature(  # type: ignore[attr-defined]
            [*fixed, *added], return_annotation=signature.return_annotation)
        lines = [inspect.cleandoc(wrapped.__doc__ or ""), "", "Often used parameters:"]
        for name in often_used:
            lines.extend(_described(PARAMETERS[name], ""))
        of_sections = "" if sections is None else f" of the sections {', '.join(sections)}"
        lines += ["", *textwrap.wrap(
            f"All {len(chosen)} parameters{of_sections} are accepted; dollytrack.parameters() lists "
            "all, dollytrack.parameters('TEXT') finds those about a subject.", 96)]
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
    if not isinstance(value, str) and not hasattr(value, "__iter__"):
        raise failure(Usage, f"Give a str or a list of str, not {type(value).__name__}.", what)
    listed = [value] if isinstance(value, str) else list(value)
    for one in listed:
        if not isinstance(one, str):
            raise failure(Usage, f"The values must be str, not {type(one).__name__}.", what)
    return listed


def names(value: Union[None, str, Iterable[str]], what: str) -> List[str]:
    """A list of names. Empty lists, for which the engine would take the default, and names with
    commas are refused."""
    listed = words(value, what)
    if value is not None and not listed:
        raise failure(Usage, "The list is empty; give at least one name, or None for the default.",
                      what)
    for one in listed:
        if "," in one:
            raise failure(Usage, f"{one!r} has several names; give them as a list, {parts(one)}.",
                          what)
    return listed


def parts(text: str) -> List[str]:
    """The names in a text that separates them by commas."""
    return [one.strip() for one in text.split(",") if one.strip()]


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


def finish(report: Optional[Callable[[float, str], object]]) -> None:
    """Reports that a call has succeeded: the engine's last report may come before its last step."""
    if report is not None:
        report(1.0, "done")


_intercepting: List[Callable[[str], bool]] = []


@contextmanager
def intercepted(messages: Iterable[str]) -> Iterator[List[str]]:
    """Collects the engine's records that are one of the messages, up to their last semicolon, instead
    of passing them to Python's logger."""
    wanted, collected = frozenset(messages), []

    def takes(message: str) -> bool:
        found = message.rpartition(";")[0] in wanted
        if found:
            collected.append(message)
        return found

    _intercepting.append(takes)
    try:
        yield collected
    finally:
        _intercepting.remove(takes)


def log(subsystem: str, level: int, message: str, count: str) -> None:
    """Passes a record of the engine to Python's logger; called by the module _core."""
    if any(takes(message) for takes in _intercepting):
        return
    with _Bar.aside():
        logging.getLogger(f"dollytrack.{subsystem}").log(level, "%s%s", in_python(message), count)


class _Bar:
    """A progress bar of tqdm if it is installed, otherwise a line on stderr."""

    _shown: "weakref.WeakSet[_Bar]" = weakref.WeakSet()

    @classmethod
    def aside(cls) -> ContextManager[object]:
        """Hides the bars while something else is written to the terminal."""
        bars = [one.bar for one in cls._shown if one.bar is not None]
        if bars:
            mode: ContextManager[object] = type(bars[0]).external_write_mode(file=sys.stderr)
            return mode
        if len(cls._shown):
            sys.stderr.write("\n")
        return nullcontext()

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self.bar: Any = None
        else:
            self.bar = tqdm(total=100, unit="%", bar_format="{desc}{percentage:3.0f}%|{bar}| "
                                                            "{elapsed}<{remaining}")
        self._shown.add(self)

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
