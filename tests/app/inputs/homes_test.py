#!/usr/bin/python3
"""Sweet Home 3D homes as archives: their content is read, harmful entries are refused.

Usage: homes_test.py PROGRAM [unittest arguments]
"""
import json
import struct
import unittest
import zipfile
import zlib

from support.program import FolderCase, run

HOME = """<?xml version='1.0'?>
<home version='7000' name='flat.sh3d' wallHeight='250.0'>
  <observerCamera attribute='storedCamera' name='Door' x='60' y='60' z='150' yaw='-0.8' pitch='0.2'
                  fieldOfView='1.1'/>
  <wall id='a' wallAtStart='d' wallAtEnd='b' xStart='0' yStart='0' xEnd='400' yEnd='0'
        height='250' thickness='10'/>
  <wall id='b' wallAtStart='a' wallAtEnd='c' xStart='400' yStart='0' xEnd='400' yEnd='300'
        height='250' thickness='10'/>
  <wall id='c' wallAtStart='b' wallAtEnd='d' xStart='400' yStart='300' xEnd='0' yEnd='300'
        height='250' thickness='10'/>
  <wall id='d' wallAtStart='c' wallAtEnd='a' xStart='0' yStart='300' xEnd='0' yEnd='0'
        height='250' thickness='10'/>
  <room name='Hall'><point x='5' y='5'/><point x='395' y='5'/><point x='395' y='295'/>
    <point x='5' y='295'/>
    <texture attribute='floorTexture' name='Tiles' width='20' height='20' image='2'/></room>
  <pieceOfFurniture name='Table' model='0' x='200' y='150' width='120' depth='80' height='75'/>
  <pieceOfFurniture name='Vase' model='1/vase.obj' x='200' y='150' elevation='75' width='15'
                    depth='15' height='30'/>
</home>
"""

BOX = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + (
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")


def png():
    """A PNG file of 4 x 4 green pixels."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b"".join(b"\0" + b"\0\xff\0" * 4 for _ in range(4))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Homes(FolderCase):
    def archive(self, name, files):
        path = self.folder / name
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as out:
            for entry, data in files:
                out.writestr(entry, data)
        return path

    def home(self, name="flat.sh3d", more=()):
        return self.archive(name, [
            ("Home.xml", HOME), ("Home", b"\xac\xed\x00\x05"), ("0", BOX), ("2", png()),
            ("1/vase.obj", "mtllib vase.mtl\nusemtl glaze\n" + BOX),
            ("1/vase.mtl", "newmtl glaze\nKd 0 0 1\n"), *more])

    def test_plans_in_a_home(self):
        path = self.home()
        result = run("plan", path, "-o", self.folder / "flat.dolly", "--json",
                     "--set", "width_px=160", "--set", "height_px=120")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout)["objects"], 2)
        self.assertNotIn("texture", result.stderr)

    def test_its_views_are_a_trajectory(self):
        result = run("compare", self.home(), "--planners", "uniform", "--max-frames", "5",
                     "--trajectory", self.home(), "--json",
                     "--set", "width_px=160", "--set", "height_px=120")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("flat.sh3d", result.stdout)

    def test_names_that_lead_out_are_refused(self):
        for name in ("../evil.obj", "/etc/evil", "a/../../evil", "..\\evil"):
            path = self.home("slip.sh3d", [(name, "x")])
            self.assertFails(run("info", path), 4, "leads out of the archive")
        self.assertFalse((self.folder.parent / "evil.obj").exists())

    def test_bombs_are_refused(self):
        path = self.home("bomb.sh3d", [("9", b"\0" * (513 << 20))])
        self.assertLess(path.stat().st_size, 1 << 20)
        self.assertFails(run("info", path), 4, "512 MiB")

    def test_encrypted_entries_are_refused(self):
        path = self.home("locked.sh3d")
        data = bytearray(path.read_bytes())
        at = 0
        while (at := data.find(b"PK\x01\x02", at)) >= 0:  # the list of files: set the flag
            data[at + 8] |= 1
            at += 4
        at = 0
        while (at := data.find(b"PK\x03\x04", at)) >= 0:
            data[at + 6] |= 1
            at += 4
        path.write_bytes(data)
        self.assertFails(run("info", path), 4, "encrypted")

    def test_homes_of_old_versions_say_how_to_convert(self):
        path = self.archive("old.sh3d", [("Home", b"\xac\xed\x00\x05sr")])
        self.assertFails(run("info", path), 4, "5.3", "save it again")

    def test_damage_is_told(self):
        whole = self.home("cut.sh3d").read_bytes()
        for share in (0.3, 0.9):
            path = self.folder / "cut.sh3d"
            path.write_bytes(whole[:int(share * len(whole))])
            self.assertFails(run("info", path), 4, "archive")

    def test_entities_are_refused(self):
        bomb = "<!DOCTYPE home [" + "".join(
            f"<!ENTITY e{i + 1} '&e{i};&e{i};'>" for i in range(40)) + "]><home>&e40;</home>"
        path = self.archive("entities.sh3d", [("Home.xml", bomb)])
        self.assertFails(run("info", path), 4, "document type")


if __name__ == "__main__":
    unittest.main()
