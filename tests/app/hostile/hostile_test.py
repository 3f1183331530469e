"""Damaged or malicious files: whatever they do to their reader, the program continues and reports
the error. Usage: hostile_test.py DOLLYTRACK IMPORT_MANY [--long]"""
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest
import zlib

IMPORT_MANY = sys.argv.pop(2)
from mutants import mutant  # noqa: E402
from support import small_models, small_scans  # noqa: E402
# Takes its own argument away.
from support.program import FolderCase, PROGRAM, run, wait_for  # noqa: E402

LONG = "--long" in sys.argv
if LONG:
    sys.argv.remove("--long")
MUTANTS = int(os.environ.get("MUTANTS", 20_000)) if LONG else 500
FIRST = int(os.environ.get("FIRST_MUTANT", 0))  # the long run can be made in parts
BAD_INPUT = 2       # the engine's code for it
LONGEST_S = 2.0     # time limit for a small file
PARENT_GROWTH_KIB = 256 * 1024
CHILD_PEAK_KIB = (4 * 1024 + 256) * 1024  # allowed by its memory limit


class Importer:
    """One process that imports several files in a row, as the editor does."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([IMPORT_MANY, *arguments], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def read(self, path):
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError(f"the program itself died on {path}: {self.process.wait()}")
        return json.loads(line)

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        return self.process.wait()


class HostileCase(FolderCase):
    def setUp(self):
        self.importer = Importer()

    def tearDown(self):
        self.assertEqual(self.importer.close(), 0)

    def write(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        return path

    def write_scenes(self):
        """All files of the scenes that consist of several files."""
        small_models.write_beside(self.folder)
        small_scans.write_beside(self.folder)

    def refused(self, path, *words, seconds=4.0, name=None):
        """The file is refused in time, with one sentence that names the file and the cause."""
        answer = self.importer.read(path)
        self.assertIn("message", answer, answer)
        self.assertEqual(answer["code"], BAD_INPUT, answer)
        self.assertIn(name or pathlib.Path(path).name, answer["where"] + answer["message"], answer)
        self.assertGreater(len(answer["message"]), 10)
        self.assertNotIn("\n", answer["message"])
        self.assertLess(answer["seconds"], seconds * SLOWNESS, answer)
        for word in words:
            self.assertIn(word, answer["message"])
        return answer


def measured_slowness():
    """Factor by which a child process is slower than on an idle machine; time limits are scaled by
    it."""
    begin = time.time()
    for _ in range(5):
        subprocess.run([PROGRAM, "--version"], stdout=subprocess.DEVNULL, check=True)
    return max(1.0, (time.time() - begin) / 5 / 0.2)


SLOWNESS = measured_slowness()


class Seeds(HostileCase):
    def test_each_kind_is_read_before_it_is_damaged(self):
        self.write("room.mtl", small_models.mtl())
        self.write("oak.png", small_models.png())
        for name, make in small_models.SEEDS.items():
            answer = self.importer.read(self.write(name, make()))
            self.assertEqual(answer.get("triangles"), 12, (name, answer))
        self.assertEqual(self.importer.read(self.folder / "room.obj")["textures"], 1)
        self.assertEqual(self.importer.read(self.folder / "room.glb")["textures"], 1)

    def test_so_is_each_kind_that_is_made_of_several_files(self):
        self.write_scenes()
        for name, make, opened, triangles in [*small_models.SCENES, *small_scans.SCENES]:
            path = self.write(name, make())
            answer = self.importer.read(self.folder / opened if opened else path)
            self.assertNotIn("message", answer)
            self.assertEqual(answer["triangles"], triangles or answer["triangles"], answer)
            if (name, make, opened, triangles) in small_models.SCENES:
                self.assertEqual(answer["warnings"], [], name)
            if name.startswith("pictures/"):
                self.assertEqual(answer["textures"], 1, name)

    def test_read_apart_or_here_it_is_the_same(self):
        self.write_scenes()
        here = Importer("--here")
        for name, make, *rest in [*small_models.SEEDS.items(), *small_models.SCENES,
                                  *small_scans.SCENES]:
            path = self.write(name, make())
            if rest and rest[0]:
                path = self.folder / rest[0]
            apart, same = self.importer.read(path), here.read(path)
            for key in ("digest", "objects", "triangles", "textures", "notes", "warnings"):
                self.assertEqual(apart[key], same[key], name)
        self.assertEqual(here.close(), 0)


class Mutants(HostileCase):
    def test_the_program_outlives_them_all(self):
        seeds = [(name, make(), None) for name, make in small_models.SEEDS.items()]
        seeds += [(name, make(), opened)
                  for name, make, opened, _ in [*small_models.SCENES, *small_scans.SCENES]]
        self.write_scenes()
        ends = dict.fromkeys(["read", "refused", "crashed", "too long"], 0)
        by_file = {}
        peak = None
        for number in range(FIRST, FIRST + MUTANTS):
            name, seed, opened = seeds[number % len(seeds)]
            damaged = self.write(name if opened else f"m{number}_{name}", mutant(seed, number))
            path = self.folder / opened if opened else damaged
            answer = self.importer.read(path)
            peak = peak or answer["peak_kib"]
            end = "read"
            if "message" in answer:
                self.assertEqual(answer["code"], BAD_INPUT, answer)
                said = answer["where"] + answer["message"]
                files = [path, *damaged.parent.iterdir()] if opened else [path]
                self.assertTrue(any(file.name in said for file in files), answer)
                end = ("crashed" if "(signal" in answer["message"] else
                       "too long" if "took longer" in answer["message"] else "refused")
            # The limit is 2 s of processor time, which does not count while other processes run.
            self.assertLess(answer["processor_seconds"], LONGEST_S + 2.0, answer)
            ends[end] += 1
            by_file.setdefault(name, dict.fromkeys(ends, 0))[end] += 1
            if end in ("crashed", "too long"):
                print(f"mutant {number} of {name}: {answer['message']}", file=sys.stderr, flush=True)
            damaged.unlink()
            if opened:
                damaged.write_bytes(seed)
            if LONG and number % 500 == 499:
                print(f"{number + 1}: {ends}", file=sys.stderr, flush=True)
        self.assertLess(answer["peak_kib"] - peak, PARENT_GROWTH_KIB)
        self.assertLess(answer["child_peak_kib"], CHILD_PEAK_KIB)
        self.assertGreater(ends["read"], MUTANTS // 50)
        self.assertGreater(ends["refused"], MUTANTS // 10)
        figures = "\n".join(f"{name}: {counts}" for name, counts in by_file.items())
        print(f"\n{MUTANTS} mutants from {FIRST}: {ends}\n{figures}", file=sys.stderr)


class HandMade(HostileCase):
    """Handmade files of kinds that are known to crash or mislead readers."""

    def gltf(self, name, document):
        return self.write(name, json.dumps(document).encode())

    def test_deep_and_cyclic_node_graphs(self):
        chain = [{"children": [i + 1]} for i in range(20_000)] + [{"mesh": 0}]
        document, _ = small_models.gltf_json()
        document = {**json.loads(small_models.gltf()), "nodes": chain,
                    "scenes": [{"nodes": [0]}]}
        self.refused(self.gltf("chain.gltf", document), "nested too deep", seconds=5)
        document["nodes"] = [{"children": [1]}, {"children": [0]}]
        self.refused(self.gltf("cycle.gltf", document), "nodes[0] occurs twice in the scene", seconds=5)

    def test_nested_brackets(self):
        self.refused(self.write("deep.gltf", b'{"asset":' + b"[" * 200_000), seconds=5)

    def test_known_endless_loop_and_counts(self):
        head = b"ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n" \
               b"property float z\nend_header\n"
        for count in (2**31, 2**32 - 1, 4_000_000_000):
            self.refused(self.write(f"count{count}.ply", head % count + b"0 0 0\n"),
                         seconds=LONGEST_S + 2)
        binary = head.replace(b"ascii", b"binary_little_endian")
        self.refused(self.write("binary.ply", binary % 4_000_000_000), seconds=LONGEST_S + 2)
        self.refused(self.write("count.stl", b"\0" * 80 + struct.pack("<I", 2**32 - 1)))

    def test_claimed_lengths(self):
        document, _ = small_models.gltf_json("data:application/octet-stream;base64,AAAA")
        document["buffers"][0]["byteLength"] = 2**32
        self.refused(self.gltf("claims.gltf", document))
        document["accessors"][0]["count"] = 2**32 - 1
        self.refused(self.gltf("accessor.gltf", document))

    def test_claims_of_packed_gltf(self):
        # Counts in Draco's own header, of faces and vertices: seven bits a byte.
        packed = small_models.DRACO_SEQUENTIAL
        self.assertEqual(packed[11:13], bytes([12, 8]))
        many = b"\xff\xff\xff\xff\x07"
        for faces, corners in ((b"\x0c", many), (many, b"\x08"), (many, many)):
            data = small_models.draco(packed[:11] + faces + corners + packed[13:])
            self.refused(self.write("counts.glb", data), seconds=LONGEST_S + 2)
        for at in range(0, len(small_models.DRACO), 3):
            cut = small_models.DRACO[:at]
            self.refused(self.write("cut.glb", small_models.draco(cut)), "Draco")
        for count in (8_000, 800_000_000, 2**62):
            self.refused(self.write("meshopt.glb", small_models.meshopt(count)))

    def test_instances_that_take_no_bytes(self):
        document, data = small_models.gltf_json()
        at = len(data)
        document["buffers"][0]["byteLength"] = at + 16
        document["bufferViews"] += [{"buffer": 0, "byteOffset": at, "byteLength": 4},
                                    {"buffer": 0, "byteOffset": at + 4, "byteLength": 12}]
        document["accessors"].append({
            "componentType": 5126, "count": 10_000_000, "type": "VEC3",
            "sparse": {"count": 1, "indices": {"bufferView": 3, "componentType": 5125},
                       "values": {"bufferView": 4}}})
        document["nodes"][1]["extensions"] = {
            "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}
        many = small_models.container(document, data + bytes(16))
        self.refused(self.write("many.glb", many), "more than 65536 mesh instances")

    def test_bad_indices_and_corners(self):
        obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        self.refused(self.write("far.obj", obj + b"f 1 2 999999999\n"))
        self.refused(self.write("negative.obj", obj + b"f 1 2 -99\n"))
        self.refused(self.write("corners.obj", obj + b"f" + b" 1 2 3" * 300_000 + b"\n"),
                     seconds=10)
        answer = self.importer.read(
            self.write("name.obj", b"o " + b"x" * 5_000_000 + b"\n" + obj + b"f 1 2 3\n"))
        self.assertTrue("message" in answer or answer["triangles"] == 1)

    def test_collada_indices_that_are_no_numbers(self):
        """assimp does not end reading such a list."""
        for index in (b"1e999", b"%n%s", b"1.5", b"x", b"<!-- c -->x", b"<![CDATA[x]]>"):
            data = small_models.dae().replace(b"<p>0 1 3", b"<p>0 1 " + index)
            answer = self.refused(self.write("index.dae", data),
                                  "index in line 9 is not a whole number", seconds=1)
            self.assertLess(answer["processor_seconds"], 1.0)

    def test_numbers_that_are_none_are_left_out(self):
        ply = small_models.ply().replace(b"5 4 3", b"nan 4 inf")
        answer = self.importer.read(self.write("nan.ply", ply))
        self.assertLess(answer["triangles"], 12)
        ply = small_models.ply().replace(b"3 0 1 3", b"3 0 1 99")
        answer = self.importer.read(self.write("index.ply", ply))
        if "message" not in answer:
            self.assertLess(answer["triangles"], 12)

    def test_ids_that_are_no_numbers_of_objects(self):
        """A face is imported whatever its object id is."""
        for form, end in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
            head = small_models.labelled_ply(form).split(b"end_header\n")[0]
            head = head.replace(b"property int object_id", b"property double object_id")
            for number in (float("nan"), float("inf"), -float("inf"), 1e300, -1e300, 0.5):
                body = b"".join(struct.pack(end + "3f", *c) for c in small_models.CORNERS)
                body += b"".join(struct.pack(end + "B3id", 3, *t, number if i < 6 else 7)
                                 for i, t in enumerate(small_models.TRIANGLES))
                answer = self.importer.read(self.write("ids.ply", head + b"end_header\n" + body))
                self.assertEqual(answer.get("triangles"), 12, (form, number, answer))

    def test_labels_of_many_objects_on_many_parts(self):
        """Memory must grow with the sum of both, not with their product."""
        objects, parts = 3_000, 30_000
        lines = ["%g %g %g" % c for c in small_models.CORNERS]
        lines += ["3 %d %d %d %d" % (*small_models.TRIANGLES[i % 12], i) for i in range(objects)]
        head = small_models.labelled_ply().split(b"end_header\n")[0]
        head = head.replace(b"element face 12", b"element face %d" % objects)
        self.write("h_semantic.ply", head + b"end_header\n" + "\n".join(lines).encode() + b"\n")
        self.write("h.house", b"ASCII 1.1\nC 0 0 chair 3 chair 0 0\n" +
                   b"".join(b"O %d 0 0 1 2 3\n" % i for i in range(objects)))
        document, data = small_models.gltf_json()
        document["accessors"].append({**document["accessors"][1], "count": 3})
        document["meshes"].append({"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]})
        document["nodes"] = [{"mesh": 0}] + [{"mesh": 1}] * parts
        document["scenes"] = [{"nodes": list(range(parts + 1))}]
        answer = self.importer.read(
            self.write("h.glb", small_models.container(document, data)))
        self.assertEqual(answer.get("triangles"), 12 + parts, answer)
        self.assertLess(answer["child_peak_kib"], 1024 * 1024)

    def test_many_materials(self):
        mtl = b"".join(b"newmtl m%d\n" % i for i in range(1_000_000))
        self.write("many.mtl", mtl)
        obj = small_models.obj().replace(b"room.mtl", b"many.mtl").replace(b"oak", b"m7")
        answer = self.importer.read(self.write("many.obj", obj))
        self.assertTrue("message" in answer or answer["triangles"] == 12, answer)

    def test_picture_bomb(self):
        rows = zlib.compress(b"\0" * 100)
        head = struct.pack(">IIBBBBB", 65_000, 65_000, 8, 2, 0, 0, 0)

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(
                ">I", zlib.crc32(kind + data))

        bomb = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows)
        self.write("bomb/oak.png", bomb + chunk(b"IEND", b""))
        self.write("bomb/room.mtl", small_models.mtl())
        answer = self.importer.read(self.write("bomb/room.obj", small_models.obj()))
        self.assertEqual((answer["triangles"], answer["textures"]), (12, 0))
        self.assertLess(answer["child_peak_kib"], CHILD_PEAK_KIB)

    def test_tables_that_lead_to_other_files(self):
        import h5py
        small_models.write_beside(self.folder)
        classes = self.folder / "ai/_detail/mesh/mesh_objects_si.hdf5"
        opened = self.folder / "ai" / "room.obj"
        (self.folder / "secret.bin").write_bytes(struct.pack("<2i", 4, 5))
        with h5py.File(self.folder / "other.hdf5", "w") as other:
            other.create_dataset("dataset", data=[4, 5], dtype="int32")

        def external(file):
            file.create_dataset("dataset", (2,), "int32",
                                external=[(str(self.folder / "secret.bin"), 0, 8)])

        def link(file):
            file["dataset"] = h5py.ExternalLink(str(self.folder / "other.hdf5"), "dataset")

        def virtual(file):
            layout = h5py.VirtualLayout((2,), "int32")
            layout[:] = h5py.VirtualSource(str(self.folder / "other.hdf5"), "dataset", (2,))
            file.create_virtual_dataset("dataset", layout)

        for lead in (external, link, virtual):
            with h5py.File(classes, "w") as file:
                lead(file)
            self.refused(opened, "dataset", name=classes.name)
            here = Importer("--here")
            self.assertIn("dataset", here.read(opened)["message"])
            here.close()

    def test_archives_that_are_none(self):
        sound = small_models.sh3d()
        for name, data in {"cut.sh3d": sound[:len(sound) // 2], "head.sh3d": b"PK\3\4",
                           "end.sh3d": b"PK\5\6" + b"\xff" * 18}.items():
            self.refused(self.write(name, data))

    def test_empty_and_pointer_files(self):
        self.refused(self.write("empty.glb", b""), "empty")
        self.refused(self.write("lfs.glb", b"version https://git-lfs.github.com/spec/v1\n"), "lfs")


class Program(FolderCase):
    """The command line itself."""

    def test_a_crash_is_one_sentence(self):
        path = self.folder / "chain.dae"
        path.write_bytes(small_models.dae().replace(b"<node id", b"<node>" * 30_000 + b"<node id")
                         .replace(b"</node>", b"</node>" * 30_001))
        result = run("info", path)
        self.assertFails(result, 4, "chain.dae", "importer crashed (signal 11)", "export it again")
        self.assertEqual(len(result.stderr.strip().splitlines()), 1)

    def test_without_its_importer_it_says_so(self):
        alone = self.folder / "alone"
        alone.mkdir()
        shutil.copy(PROGRAM, alone / "dollytrack")
        (self.folder / "room.obj").write_bytes(small_models.obj())
        result = subprocess.run([alone / "dollytrack", "info", self.folder / "room.obj"],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("dollytrack-import", result.stderr)
        self.assertIn("in the folder of this program", result.stderr)

    def test_the_importer_alone_says_what_it_is(self):
        importer = pathlib.Path(PROGRAM).parent / "dollytrack-import"
        for arguments in ([], ["room.obj"], ["--help"]):
            result = subprocess.run([importer, *arguments], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertIn("does nothing by itself", result.stderr)

    def start_long_reading(self):
        """Starts the program with a scene that takes seconds to read; returns it and its importer's
        process number."""
        path = self.folder / "large.obj"
        if not path.exists():
            with path.open("w") as file:
                for i in range(400_000):
                    file.write(f"v {i % 997}.5 {i % 991}.25 {i % 983}.125\n")
                for i in range(1, 399_990):
                    file.write(f"f {i} {i + 3} {i + 7}\n")
        process = subprocess.Popen([PROGRAM, "--no-cache", "info", path], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)

        def importers():
            found = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True)
            return found.stdout.split()

        self.assertTrue(wait_for(importers))
        return process, int(importers()[0])

    def test_cancelling_ends_the_child(self):
        process, importer = self.start_long_reading()
        opened = pathlib.Path(f"/proc/{importer}/fd")
        self.assertTrue(wait_for(lambda: any("large.obj" in str(fd.resolve())
                                             for fd in opened.iterdir())))
        process.send_signal(signal.SIGINT)
        begin = time.time()
        process.communicate(timeout=60)
        self.assertLess(time.time() - begin, 2.0 * SLOWNESS)
        self.assertEqual(process.returncode, 130)
        self.assertFalse(pathlib.Path(f"/proc/{importer}").exists())

    def test_large_files_may_take_more_processor_time(self):
        process, importer = self.start_long_reading()
        limits = pathlib.Path(f"/proc/{importer}/limits")

        def seconds():
            limit = re.search(r"Max cpu time +(\d+)", limits.read_text())
            return int(limit.group(1)) if limit else 0

        # About 40 s for a small file, plus 8 s per MiB.
        self.assertTrue(wait_for(lambda: seconds() > 100))
        process.kill()
        process.communicate()

    def test_whoever_ignores_the_ends_of_children_is_served(self):
        (self.folder / "room.obj").write_bytes(small_models.obj())
        begin = time.time()
        result = subprocess.run(
            [PROGRAM, "--no-cache", "info", self.folder / "room.obj"], capture_output=True,
            text=True, preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(time.time() - begin, 8.0 * SLOWNESS)

    def test_pictures_are_the_same_however_the_scene_is_named(self):
        """A subfolder may have the same name as the scene's folder."""
        folder = self.folder / "maps"
        (folder / "maps").mkdir(parents=True)
        (folder / "room.obj").write_bytes(small_models.obj())
        (folder / "room.mtl").write_text("newmtl oak\nmap_Kd maps/oak.png\n")
        (folder / "maps" / "oak.png").write_bytes(small_models.png())
        (folder / "oak.png").write_bytes(b"no picture")
        for name in [folder / "room.obj", pathlib.Path("maps") / "room.obj"]:
            result = subprocess.run([PROGRAM, "--no-cache", "info", "--json", name],
                                    capture_output=True, text=True, cwd=self.folder)
            self.assertEqual(json.loads(result.stdout)["textures_found"], 1, name)

    def test_cached_scenes(self):
        folder = self.folder / "cached"
        folder.mkdir()
        (folder / "room.obj").write_bytes(small_models.obj())
        (folder / "room.mtl").write_bytes(small_models.mtl())
        (folder / "oak.png").write_bytes(small_models.png())
        cache = self.folder / "cache"
        environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
        environment.pop("DOLLYTRACK_NO_CACHE", None)

        def info(*options, **changes):
            result = run(*options, "info", "--json", folder / "room.obj",
                         env={**environment, **changes})
            self.assertEqual(result.returncode, 0, result.stderr)
            return result.stdout

        def entries():
            return sorted(cache.rglob("*.scene"))

        first = info("--no-cache")
        self.assertEqual(entries(), [])
        self.assertEqual(info(DOLLYTRACK_NO_CACHE="1"), first)
        self.assertEqual(info(DOLLYTRACK_CACHE_MB="0"), first)
        self.assertEqual(entries(), [])
        self.assertEqual(info(), first)
        self.assertEqual(len(entries()), 1)
        # The cache is really used: an entry that is read becomes the most recent.
        os.utime(entries()[0], (1, 1))
        self.assertEqual(info(), first)
        self.assertGreater(entries()[0].stat().st_mtime, 1e9)
        (folder / "oak.png").unlink()
        self.assertNotEqual(info(), first)
        (folder / "oak.png").write_bytes(small_models.png())
        self.assertEqual(info(), first)
        entries()[0].write_bytes(b"damaged")
        self.assertEqual(info(), first)
        # A link in place of a cache folder is not followed, not even to free space.
        pictures = self.folder / "pictures"
        pictures.mkdir()
        (pictures / "mine.scene").write_bytes(bytes(3 << 20))
        os.utime(pictures / "mine.scene", (1, 1))
        for name in ["scenes", "."]:
            place = cache / "dollytrack" / name
            shutil.rmtree(place)
            pathlib.Path(os.path.normpath(place)).symlink_to(pictures)
            self.assertEqual(info(DOLLYTRACK_CACHE_MB="1"), first)
            self.assertEqual(os.listdir(pictures), ["mine.scene"])
        # The cache has no folder to write to.
        self.assertEqual(info(XDG_CACHE_HOME="/proc/nowhere"), first)
        self.assertEqual(info(XDG_CACHE_HOME="relative", HOME="/proc/nowhere"), first)


if __name__ == "__main__":
    unittest.main()
