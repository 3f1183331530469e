"""Wrong arguments of every kind for every function of the Python module: each is accepted or
refused with a documented exception; the interpreter never crashes. Runs in a separate process with
a fixed seed; --long tries more."""
import sys
import unittest

LONG = "--long" in sys.argv and not sys.argv.remove("--long")

from module import FolderCase, SIZE, dt, start_python, tiny_room  # noqa: E402

FUZZ = r"""
import gc, pathlib, random, threading, warnings
import numpy as np
import dollytrack as dt
from dollytrack import _core
warnings.simplefilter("ignore")
room, folder, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
chance = random.Random(4)
scene = dt.load(room)
plan = scene.plan(max_frames=4, width_px=64, height_px=48)
frames = plan.render("instance")
closed = plan.render("rgb")
closed.close()
vertices, faces = np.array(scene.vertices), np.array(scene.faces).astype(np.int64)
ids = np.array(scene.face_objects).astype(int) - 1
poses = plan.poses
read_only = poses.copy(); read_only.setflags(write=False)

class Liar:
    def __len__(self): return 3
    def __getitem__(self, i): raise RuntimeError("no")
    def __index__(self): return 10**30
    def __float__(self): return float("nan")
    def __fspath__(self): return 7

class Raising:
    def __array__(self, *_): raise ValueError("no array")
    def __iter__(self): raise ValueError("no items")

def values():
    numbers = [0, -1, 1, 3, 2**31, 2**63, 2**64, -2**63, 10**40, 0.5, -0.0, 1e308, float("nan"),
               float("inf"), True, None, 1j]
    texts = ["", "x", "fill", "a\0b", "\ud800", "\U0001f600", "x" * 5000, "::", "::0", "-1:", "rgb",
             "all", "%s%n", "../..", "/dev/zero", "/dev/stdin", "/proc/self/mem", b"bytes", b"\xff"]
    arrays = [np.zeros(n) for n in (0, 1, 3, 16)] + [
        np.zeros((0, 4, 4)), np.zeros((2, 4, 4)), np.eye(4), np.eye(4)[None] * np.nan,
        np.zeros((2, 3, 3, 3)), poses, poses[::-1], poses[::2], np.asfortranarray(poses), read_only,
        poses.astype(np.float32), poses.astype(">f8"), poses.astype(object), poses.astype(complex),
        poses.astype(str), poses[..., ::-1], poses.transpose(0, 2, 1), vertices, vertices[::2],
        vertices * 1e30, vertices.astype(np.float16), faces, faces - 1, faces + 10**6,
        faces.astype(np.int8), faces.astype(np.uint64) + 2**63, faces.astype(float), ids, ids + 10**5,
        ids[::-1], np.array("text"), np.array([None, 1], object), np.ma.masked_all(3),
        np.zeros(3, "datetime64[s]"), np.zeros(2, [("x", int)]),
        np.lib.stride_tricks.as_strided(np.zeros(1), (10**6, 4, 4), (0, 0, 0))[:50]]
    others = [[], (), {}, set(), [[]], [1, "a"], ["a", None], {"a": 1}, [poses], object(), Liar(),
              Raising(), print, int, scene, plan, frames, closed, Ellipsis, slice(1, 2), range(3),
              np.random, ([1, 2, 3], [4, 5, 6]), ([1, 2], [3]), ([float("nan")] * 3, [0] * 3)]
    return numbers + texts + arrays + others

pool = values()
def unbound_plan(*given, **keywords): return _core.Scene.plan(*given, **keywords)
names = list(dt.PARAMETERS)
calls = {
    dt.load: ["unit_m", "up_axis", "labels", "models", "annotations", "keep_meshes", "cloud", "progress"],
    dt.Scene.from_arrays: ["object_ids", "names", "classes", "structure",
                            "colors", "progress"],
    scene.plan: ["ignore", "only", "start", "end", "time_s", "progress"],
    scene.__getitem__: [], plan.explain: ["progress"],
    plan.coverage: ["progress"], plan.render: ["range", "still", "gl", "progress"],
    plan.save: [], plan.export: ["modalities", "formats", "range", "flow_distances", "folds",
        "fold_seed", "rig", "cameras", "still", "overwrite", "resume", "gl", "progress"],
    dt.judge: ["times", "paths", "progress"], dt.set_threads: [], dt.Dataset: [], dt.Scene: [],
    dt.Plan: [],
    unbound_plan: ["assignments", "ignore", "only", "start", "end", "time_s", "progress"],
    scene._core.judge: ["poses", "times_s", "paths", "assignments", "progress"],
    scene._core.plan: ["assignments", "ignore", "only", "start", "end", "time_s", "progress"],
    plan._core.explain: ["ids", "progress"], plan._core.render: ["modalities", "range", "still", "gl",
        "assignments", "progress"],
    frames._core.next: [], closed.__next__: [], closed._core.next: [], closed.close: [],
    scene.saved_plan: ["progress"],
}
fits = {dt.load: [room], dt.Scene.from_arrays: [vertices, faces], scene.plan: [], plan.explain: ["mug"],
        dt.judge: [scene, poses], plan.render: ["rgb"], plan.export: [folder + "/out"],
        scene._core.judge: [poses, np.arange(4.0), np.zeros(4, np.int32), [], None],
        scene._core.plan: [[], [], [], "", "", None, None], plan._core.explain: [[1], None],
        plan._core.render: [["instance"], "::", False, "osmesa", [], None]}
allowed = (dt.Error, TypeError, ValueError, KeyError, IndexError, AttributeError, StopIteration,
           OverflowError, RuntimeError, OSError, RecursionError, MemoryError)
refused = taken = 0
for turn in range(count):
    function = chance.choice(list(calls))
    keywords = {}
    if function in fits and chance.random() < 0.7:
        given = list(fits[function])
        if given and chance.random() < 0.6:
            given[chance.randrange(len(given))] = chance.choice(pool)
        free = calls[function] if not getattr(function, "__self__", None) in (scene._core, plan._core) else []
        for name in chance.sample(free, min(len(free), chance.randrange(3))):
            keywords[name] = chance.choice(pool)
        if chance.random() < 0.4:
            keywords[chance.choice(names)] = chance.choice(pool)
        if function == plan.export and chance.random() < 0.8:
            keywords["range"] = "0:1"
        if function == scene.plan:
            keywords.setdefault("max_frames", 3)
    else:
        given = [chance.choice(pool) for _ in range(chance.randrange(5))]
        keywords = {name: chance.choice(pool) for name in calls[function] if chance.random() < 0.3}
    if dt.set_threads == function:
        given = [one for one in given if not (isinstance(one, (int, np.ndarray)) and one is not None)]
    if function in (dt.load, dt.Scene.from_arrays, plan.save, dt.Dataset):
        given = [one if not (isinstance(one, str) and one.startswith("/dev")) else "x" for one in given]
    try:
        function(*given, **keywords)
        taken += 1
    except allowed:
        refused += 1
    if turn % 50 == 0:
        gc.collect()
assert refused > count // 3 and taken > 10, (refused, taken)
# What was made before still works, and gives what it gave.
assert (scene.plan(max_frames=4, width_px=64, height_px=48).poses == poses).all()
assert len(list(plan.render("instance", range="0:2"))) == 2
# Threads that use and drop the same things.
def use():
    for _ in range(3):
        mine = scene.plan(max_frames=2, width_px=32, height_px=32)
        for frame in mine.render("depth", range="0:1"):
            frame["depth"].sum()
threads = [threading.Thread(target=use) for _ in range(4)]
[thread.start() for thread in threads]
del closed
gc.collect()
[thread.join() for thread in threads]
shared = plan.render("instance")
def take():
    try:
        for _ in shared:
            pass
    except dt.Usage:
        pass
threads = [threading.Thread(target=take) for _ in range(4)]
[thread.start() for thread in threads]
shared.close()
[thread.join() for thread in threads]
print("sound", refused, taken)
"""


class FuzzTest(FolderCase):
    def test_wrong_arguments_never_crash_the_interpreter(self):
        tiny_room.write(self.folder / "room.obj")
        inner = self.folder / "a" / "b" / "c"  # paths with ".." stay inside the folder
        inner.mkdir(parents=True)
        process = start_python(FUZZ, self.folder / "room.obj", inner, 20_000 if LONG else 600,
                               cwd=inner)
        out, errors = process.communicate(timeout=7200)
        self.assertEqual(process.returncode, 0, errors[-3000:])
        self.assertIn("sound", out)


if __name__ == "__main__":
    unittest.main()
