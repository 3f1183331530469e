"""The package's types: mypy finds no error, and _core.pyi matches the extension."""
import ast
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from module import MODULE
from dollytrack import _core

PACKAGE = pathlib.Path(MODULE) / "dollytrack"
#: Expressions of a caller's script, and their types.
REVEALED = {
    "plan": "Plan", "plan.metrics": "dict[str, Any]", "plan.render()": "Frames",
    "next(plan.render('rgb', render_mode='traced'))": "Frame", "plan.export('x')": "dict[str, Any]",
    "next(plan.render()).pose": "numpy.ndarray[Any, numpy.dtype[numpy.floating[numpy._typing._64Bit]]]",
    "dt.judge(plan.scene, plan.poses)": "dict[str, Any]", "dt.Dataset('x').void_id": "int",
}
#: Lines of a caller's script that are wrong, with the part of the error that tells why.
WRONG = {
    "name: str = dt.Dataset('x')[0].index": "int",
    "plan.export('x', presett='nerf')": "presett",
    "plan.render(fill=0.5)": "fill",  # affects the plan, not the image
    "plan.scene.plan(fil=0.5)": "fil",
    "plan.scene.plan(camera_preset='dron')": "Literal['dron']",
    "plan.scene.plan(loop='yes')": "loop",
    "dt.judge(plan.scene, plan.poses, fill=0.5)": "fill",
    "plan.render('rgb', gl='cuda')": "Literal['cuda']",
    "plan.export('x', gl='cuda')": "Literal['cuda']",
    "plan.render('color')": "Literal['color']",
    "dt.load('x', up_axis='up')": "Literal['up']",
    "dt.Dataset('x').torch(boxes='xywh')": "No overload variant",
}
#: Lines that are right.
RIGHT = ("import numpy as np", "plan.scene.plan(fill=np.float32(0.5), max_frames=np.int64(3), loop=True)",
         "plan.render('rgb', render_mode='traced', exposure_ev=1)", "plan.export('x', preset='nerf')",
         "plan.render('rgb', gl='egl')", "plan.export('x', flow_distances=3)",
         "dt.load('x', up_axis='-y')", "dt.Dataset('x').torch(boxes='xyxy', images='depth')",
         "dt.judge(plan.scene, plan.poses, camera_radius_m=0.2)")
if importlib.util.find_spec("torch") is not None:
    REVEALED["dt.Dataset('x').torch()[0]"] = (
        "Tuple[torch._tensor.Tensor, dict[str, torch._tensor.Tensor]]")
    REVEALED["dt.Dataset('x').torch(transform=lambda image, target: image)[0]"] = "torch._tensor.Tensor"


class TypingTest(unittest.TestCase):
    def test_mypy_finds_nothing_wrong(self):
        if shutil.which("mypy") is None:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as cache:
            user = pathlib.Path(cache) / "user.py"
            user.write_text("\n".join([
                "import dollytrack as dt",
                "plan = dt.load('room.glb').plan(fill=0.6)",
                *(f"reveal_type({value})" for value in REVEALED), *RIGHT, *WRONG]))
            settings = pathlib.Path(cache) / "mypy.ini"
            # Without PyTorch, its classes are of type Any.
            settings.write_text("[mypy]\nenable_incomplete_feature = Unpack\n[mypy-torch.*]\nignore_missing_imports = True\n"
                                "[mypy-dollytrack.torch_dataset]\ndisallow_subclassing_any = False\n")
            done = subprocess.run(["mypy", "--strict", "--config-file", settings, "--cache-dir",
                                   cache, PACKAGE], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            done = subprocess.run(["mypy", "--strict", "--config-file", settings, "--cache-dir",
                                   cache, user], text=True, capture_output=True,
                                  env={"MYPYPATH": str(PACKAGE.parent)})
            errors = [line for line in done.stdout.splitlines() if " error: " in line]
            self.assertEqual(len(errors), len(WRONG), done.stdout)
            for error, (line, reason) in zip(errors, WRONG.items()):
                self.assertIn(reason, error, line)
            found = re.findall(r'Revealed type is "(.*)"', done.stdout)
            self.assertEqual(len(found), len(REVEALED))
            for (value, wanted), text in zip(REVEALED.items(), found):
                self.assertEqual(re.sub(r"\b(builtins|typing|dollytrack\.\w+)\.", "", text), wanted,
                                 value)

    def test_the_stub_has_the_extensions_names_and_arguments(self):
        tree = ast.parse((PACKAGE / "_core.pyi").read_text())
        self.compare(tree.body, _core)

    def compare(self, body, owner):
        described = {}
        for node in body:
            if isinstance(node, ast.ClassDef):
                self.compare(node.body, getattr(owner, node.name))
                described[node.name] = None
            elif isinstance(node, ast.FunctionDef):
                described[node.name] = [one.arg for one in node.args.args]
            elif isinstance(node, ast.AnnAssign):
                described[node.target.id] = None
        public = {name for name in vars(owner) if not name.startswith("_")}
        self.assertEqual(set(described), public)
        for name, arguments in described.items():
            text = getattr(getattr(owner, name), "__doc__", None) or ""
            signature = re.match(rf"{name}\((.*)\) ->", text)
            if arguments is None or signature is None:
                continue
            found = re.findall(r"(\w+): ", signature[1])
            self.assertEqual([re.sub(r"^arg0$", "self", one) for one in found], arguments, name)


if __name__ == "__main__":
    unittest.main()
