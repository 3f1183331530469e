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

from module import MODULE, ROOT
from dollytrack import _core

PACKAGE = ROOT / "app" / "python" / "dollytrack"
#: Expressions of a caller's script, and their types.
REVEALED = {
    "plan": "Plan", "plan.metrics": "dict[str, Any]", "plan.render()": "Frames",
    "next(plan.render('rgb', render_mode='traced'))": "Frame", "plan.export('x')": "dict[str, Any]",
    "next(plan.render()).pose": "numpy.ndarray[Any, numpy.dtype[numpy.floating[numpy._typing._64Bit]]]",
    "dt.judge(plan.scene, plan.poses)": "dict[str, Any]", "dt.Dataset('x').void_id": "int",
}
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
                "name: str = dt.Dataset('x')[0].index",  # wrong, and must be found
                *(f"reveal_type({value})" for value in REVEALED)]))
            settings = pathlib.Path(cache) / "mypy.ini"
            # Without PyTorch, its classes are of type Any.
            settings.write_text("[mypy]\n[mypy-torch.*]\nignore_missing_imports = True\n"
                                "[mypy-dollytrack.torch_dataset]\ndisallow_subclassing_any = False\n")
            done = subprocess.run(["mypy", "--strict", "--config-file", settings, "--cache-dir",
                                   cache, PACKAGE], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            done = subprocess.run(["mypy", "--strict", "--config-file", settings, "--cache-dir",
                                   cache, user], text=True, capture_output=True,
                                  env={"MYPYPATH": str(PACKAGE.parent)})
            self.assertEqual(done.stdout.count(" error: "), 1, done.stdout)
            self.assertIn("user.py:3", done.stdout)
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
