"""Plans camera trajectories in indoor 3D scenes and renders them as labelled datasets.

    import dollytrack as dt
    plan = dt.load("room.glb").plan(max_frames=300)
    plan.export("dataset")
    dataset = dt.Dataset("dataset")

Conventions: metres, seconds, radians unless a name ends in _deg. The world is right-handed with z up.
A pose is the 4 x 4 matrix world_from_camera; a camera's axes are x right, y down, z forward (OpenCV).
Images are arrays of height x width, rows from the top; the centre of the first pixel is at (0.5, 0.5).

Datasets need NumPy alone. The engine is loaded when it is first asked for.
"""
from typing import TYPE_CHECKING, Any, List

from .dataset import Dataset, Sample, Tracks
from .errors import BadInput, Cancelled, CannotWrite, Error, Failed, NoOpenGl, Usage

if TYPE_CHECKING:
    from ._core import version as __version__
    from .arguments import PARAMETERS as PARAMETERS, parameters as parameters
    from .plan import Frame as Frame, Frames as Frames, Plan as Plan
    from .scene import Scene as Scene, SceneObject as SceneObject
    from .scene import judge as judge, load as load, set_threads as set_threads

__all__ = ["BadInput", "Cancelled", "CannotWrite", "Dataset", "Error", "Failed", "Frame", "Frames",
           "NoOpenGl", "PARAMETERS", "Plan", "Sample", "Scene", "SceneObject", "Tracks", "Usage", "judge",
           "load", "parameters", "set_threads"]

_OF_ENGINE = {"PARAMETERS": "arguments", "Frame": "plan", "Frames": "plan", "Plan": "plan",
              "Scene": "scene", "SceneObject": "scene", "judge": "scene", "load": "scene",
              "parameters": "arguments", "set_threads": "scene"}


def __getattr__(name: str) -> Any:
    from importlib import import_module
    if name == "__version__":
        return import_module("._core", __name__).version
    if name not in _OF_ENGINE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_OF_ENGINE[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> List[str]:
    return sorted([*__all__, "__version__"])
