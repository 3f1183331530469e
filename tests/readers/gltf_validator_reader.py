"""Khronos' validator finds no error in trajectory.glb."""
import json
import pathlib
import unittest

import exports

HERE = pathlib.Path(__file__).parent
CHECK = """
const validator = require(process.argv[1]);
const bytes = new Uint8Array(require("fs").readFileSync(process.argv[2]));
validator.validateBytes(bytes).then(report => console.log(JSON.stringify(report)));
"""


class GltfValidator(unittest.TestCase):
    def test_it_finds_neither_errors_nor_warnings(self):
        exports.need_program("node", "nodejs")
        module = HERE / "node_modules" / "gltf-validator"
        if not module.exists():
            exports.missing("gltf-validator", f"it by: npm ci --prefix {HERE}")
        report = json.loads(exports.call("node", "-e", CHECK, module,
                                         exports.walk().folder / "trajectory.glb"))
        issues = report["issues"]
        self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), issues["messages"])
        self.assertEqual(report["info"]["animationCount"], 1)
