"""Compares the Python module with the command line, with files that OpenCV reads, and with known
geometry."""
import gc
import importlib.util
import inspect
import json
import logging
import pydoc
import os
import pickle
import subprocess
import sys
import typing
import unittest
import warnings

import cv2
import numpy as np

from module import (MODULE, ROOT, RoomCase, SET, SIZE, dt, hashes, run, start_python,
                    tiny_room)
from dollytrack import arguments as python_arguments
from dollytrack import errors, plan as plan_module

HAS_TORCH = importlib.util.find_spec("torch") is not None
ROOM = [("floor", (0, -0.1, 0), (4, 0, 3)), ("ceiling", (0, 2.6, 0), (4, 2.7, 3)),
        ("wall_1", (-0.1, 0, 0), (0, 2.6, 3)), ("wall_2", (4, 0, 0), (4.1, 2.6, 3)),
        ("wall_3", (0, 0, -0.1), (4, 2.6, 0)), ("wall_4", (0, 0, 3), (4, 2.6, 3.1)),
        ("table", (2.8, 0, 0.8), (3.6, 0.74, 2.2)), ("sofa", (0.1, 0, 0.6), (0.9, 0.7, 2.4)),
        ("crate", (1.6, 0, 0.2), (2.2, 0.5, 0.8))]
FACES = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def arrays():
    """The boxes of ROOM as vertices (z up), faces and object ids."""
    vertices, faces, ids = [], [], []
    for number, (_, (x0, y0, z0), (x1, y1, z1)) in enumerate(ROOM):
        first = len(vertices)
        vertices += [(x, -z, y) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
        for a, b, c, d in FACES + first:
            faces += [(a, b, c), (a, c, d)]
            ids += [number, number]
    return np.array(vertices), np.array(faces), np.array(ids)


class EngineTest(RoomCase):

    # --- scenes

    def test_a_scene_has_the_objects_of_its_file(self):
        info = json.loads(run("info", self.room, "--json").stdout)
        self.assertEqual(self.scene.report["objects"], info["objects"])
        table = self.scene["table"]
        self.assertEqual((table.class_name, table.role), ("table", "target"))
        # The file has y up: x, y, z of the file are x, z, -y of the world.
        low, high = (2.8, -2.2, 0.0), (3.6, -0.8, 0.74)
        np.testing.assert_allclose(table.corners.min(axis=0), low, atol=1e-5)
        np.testing.assert_allclose(table.corners.max(axis=0), high, atol=1e-5)
        np.testing.assert_allclose(np.prod(table.size), 0.8 * 1.4 * 0.74, rtol=1e-5)
        corners = self.scene.vertices[self.scene.faces[table.faces]].reshape(-1, 3)
        np.testing.assert_allclose(corners.min(axis=0), low, atol=1e-5)
        self.assertTrue((self.scene.face_objects[table.faces] == table.id).all())
        self.assertEqual(self.scene.boxes.shape, (len(self.scene), 7))
        self.assertEqual(self.scene.classes[table.class_id], "table")

    def test_arrays_outlive_their_scene_and_cannot_be_written(self):
        scene = dt.load(self.room)
        before, vertices = scene.vertices.copy(), scene.vertices
        del scene
        gc.collect()
        np.testing.assert_array_equal(vertices, before)
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1.0

    def test_a_scene_of_arrays_is_the_scene_of_a_file(self):
        vertices, faces, ids = arrays()
        names = [name for name, _, _ in ROOM]
        kinds = [None] * 8 + ["box"]
        colors = np.full((len(ROOM), 3), 200, np.uint8)
        colors[6] = (200, 30, 30)
        scene = dt.Scene.from_arrays(vertices, faces, ids, names, kinds, colors=colors)
        self.assertEqual([o.name for o in scene.objects], names)
        self.assertEqual([o.name for o in scene.objects if o.role == "target"], names[6:])
        self.assertEqual([scene[name].class_name for name in ("table", "sofa", "crate", "floor")],
                         ["table", "sofa", "box", "floor"])
        tiny_room.write_boxes(self.folder / "same.obj", ROOM)
        same = dt.load(self.folder / "same.obj", unit_m=1, up_axis="y")
        for name in names:
            np.testing.assert_allclose(scene[name].corners.min(axis=0),
                                       same[name].corners.min(axis=0), atol=1e-6)
        plan = scene.plan(max_frames=6, **SIZE)
        self.assertEqual(plan.metrics["captured"], 3)
        frame = next(iter(plan.render("albedo", "instance")))
        red = (frame["albedo"].astype(int) - (200, 30, 30) == 0).all(axis=2)
        np.testing.assert_array_equal(red, frame["instance"] == scene["table"].id)
        with self.assertRaisesRegex(dt.Usage, "temporary file"):
            plan.save(self.folder / "arrays.dolly")
        kept = dt.Scene.from_arrays(vertices, faces, ids, names, file=self.folder / "kept.glb")
        kept.plan(max_frames=4).save(self.folder / "kept.dolly")
        self.assertEqual(len(dt.load(self.folder / "kept.dolly").saved_plan()), 4)

    def test_arrays_by_object_need_the_objects_ids(self):
        vertices, faces, _ = arrays()
        names = [name for name, _, _ in ROOM]
        for given in ({"names": names}, {"classes": names}, {"structure": [True] * len(ROOM)}):
            with self.subTest(*given), self.assertRaisesRegex(dt.Usage, f"^{[*given][0]}: .*object_ids"):
                dt.Scene.from_arrays(vertices, faces, **given)

    def test_unknown_class_words_are_one_warning(self):
        vertices, faces, ids = arrays()
        names = [name for name, _, _ in ROOM]
        file = self.folder / "words.glb"
        with self.assertLogs("dollytrack.import", logging.WARNING) as logs:
            scene = dt.Scene.from_arrays(vertices, faces, ids, names, ["foo"] * 7 + ["qux", None],
                                         file=file)
        [line] = logs.output
        for word in ('"foo"', '"qux"', "of 9 objects", "Scene.classes"):
            self.assertIn(word, line)
        # Class words decide whether an object is structure, before its name.
        self.assertEqual({o.role for o in scene.objects}, {"target"})
        labels = self.folder / "words.csv"
        labels.write_text("foo,table\n")
        self.assertEqual(dt.load(file, labels=labels)["floor"].class_name, "table")
        # Messages of other calls are passed on.
        with self.assertLogs("dollytrack.import", logging.WARNING), \
                python_arguments.intercepted(["mine"]) as mine:
            python_arguments.log("import", logging.WARNING, "other; do this", "")
            python_arguments.log("import", logging.WARNING, "mine; do this", "")
        self.assertEqual(mine, ["mine; do this"])

    def test_wrong_arrays_are_told_by_their_rows_and_shapes(self):
        vertices, faces, ids = arrays()
        poses, count = self.plan.poses, len(ROOM)
        no_pose, far, unlisted = poses.copy(), vertices.astype(float), faces.copy()
        no_pose[3, 1, 2], far[5, 0], unlisted[7, 2] = np.nan, np.inf, len(vertices)
        for text, call in (
                (r"^poses\[3\]: .*finite: nan", lambda: dt.judge(self.scene, no_pose)),
                (r"^poses\[0\]: .*rigid", lambda: dt.judge(self.scene, 2 * poses)),
                (r"^poses: .*\(N, 4, 4\), N from 1 to", lambda: dt.judge(self.scene, poses[:0])),
                ("^poses: ", lambda: dt.judge(self.scene, [[1], [2, 3]])),
                (r"^times: .* must be \(8,\)\.$", lambda: dt.judge(self.scene, poses, [0, 1])),
                (r"^times\[2\]: .*later", lambda: dt.judge(self.scene, poses, [0, 1, 1, *range(3, 8)])),
                (r"^vertices\[5\]: .*finite: inf", lambda: dt.Scene.from_arrays(far, faces, ids)),
                (r"^vertices: .*N from 1", lambda: dt.Scene.from_arrays(vertices[:0], faces, ids)),
                (rf"^faces\[7\]: The index {len(vertices)} ",
                 lambda: dt.Scene.from_arrays(vertices, unlisted, ids)),
                (rf"^object_ids: .* must be \({len(faces)},\)\.$",
                 lambda: dt.Scene.from_arrays(vertices, faces, ids[:5])),
                ("^structure: .*booleans", lambda: dt.Scene.from_arrays(
                    vertices, faces, ids, structure=["floor"] * count))):
            with self.subTest(text), self.assertRaisesRegex((dt.Usage, dt.BadInput), text):
                call()

    # --- plans

    def test_a_plan_is_the_command_lines(self):
        printed = json.loads(run("plan", self.room, "--max-frames", 8, *SET, "--json").stdout)
        ours = self.plan.metrics
        timeless = {name for name in printed if not name.endswith("_ms") and name != "stages"}
        self.assertEqual({n: ours[n] for n in timeless}, {n: printed[n] for n in timeless})
        self.assertEqual(self.plan.ledger, printed["ledger"])
        ours, theirs = self.folder / "ours.dolly", self.folder / "theirs.dolly"
        self.plan.save(ours)
        self.assertEqual(run("plan", self.room, "--max-frames", 8, *SET, "-o", theirs).returncode, 0)
        self.assertEqual(ours.read_bytes(), theirs.read_bytes())

    def test_planning_again_gives_the_plan_from_scratch(self):
        changed = self.scene.plan(fill=0.5, max_frames=8, ignore=["sofa"], **SIZE)
        fresh = dt.load(self.room).plan(fill=0.5, max_frames=8, ignore=["sofa"], **SIZE)
        np.testing.assert_array_equal(changed.poses, fresh.poses)
        self.assertNotIn("sofa", [row["object"] for row in changed.ledger])
        again = self.scene.plan(max_frames=8, **SIZE)
        np.testing.assert_array_equal(again.poses, self.plan.poses)

    def test_parameters_are_those_of_the_command_line(self):
        sections = json.loads(run("params", "--json").stdout)
        listed = {name: value for section in sections.values() for name, value in section.items()}
        self.assertEqual({p.name: p.default for p in dt.PARAMETERS.values()}, listed)
        self.assertEqual(self.plan.parameters["timing"]["max_frames"], 8)
        self.assertIn("fill: float = 0.72", dt.Scene.plan.__doc__)
        signature = inspect.signature(dt.Scene.plan)
        self.assertEqual(signature.parameters["loop"].default, False)
        self.assertIn("render_mode", inspect.signature(dt.Plan.export).parameters)
        self.assertNotIn("fill", inspect.signature(dt.Plan.export).parameters)

    def test_help_is_short_and_says_how_to_list_all_parameters(self):
        for function, one in [(dt.Scene.plan, "fill"), (dt.Plan.render, "light_preset"),
                              (dt.Plan.export, "light_preset"), (dt.judge, "camera_radius_m")]:
            with self.subTest(function.__name__):
                text = pydoc.render_doc(function, renderer=pydoc.plaintext)
                self.assertLess(len(text.splitlines()), 80)
                self.assertLess(max(map(len, text.splitlines())), 600)
                self.assertIn(f"\n    {one}: ", text)
                self.assertIn("dollytrack.parameters()", text)
                self.assertIn(one, inspect.signature(function).parameters)

    def test_parameters_are_found_by_a_text(self):
        self.assertEqual(dict(dt.parameters()), dict(dt.PARAMETERS))
        found = dt.parameters("Frame_Rate")
        self.assertIn("frame_rate", found)
        self.assertNotIn("fill", found)
        for one in found.values():
            self.assertIn(f"  {one.name}: {one.type.__name__} = {one.default!r}", repr(found))
        limit = dt.parameters("max_repeat_rate")
        self.assertEqual(limit["max_repeat_rate"].range, "0 .. 1")
        self.assertIn("(0 .. 1; only with max_frames>0)", repr(limit))
        self.assertEqual(dt.parameters("no such text"), {})
        with self.assertRaises(dt.Usage):
            dt.parameters(3)

    def test_numpy_numbers_are_parameters(self):
        plan = self.scene.plan(fill=np.float32(0.5), max_frames=np.int64(8), loop=np.bool_(True))
        self.assertEqual(plan.parameters["viewpoints"]["fill"], 0.5)
        self.assertEqual(plan.parameters["constraints"]["loop"], True)

    def test_an_explanation_says_what_helps(self):
        # The same output as of the command line with --explain.
        settings = {"max_pitch_deg": 0.0, "min_pitch_deg": -5.0, "max_frames": 2}
        plan = self.scene.plan(**settings)
        printed = json.loads(run("plan", self.room, "--explain", "--json", *[
            word for name, value in settings.items() for word in ("--set", f"{name}={value}")]).stdout)
        lost = [row for row in printed["ledger"] if not row["well_captured"]]
        self.assertTrue(lost)
        for row in printed["ledger"]:
            self.assertEqual(plan.explain(row["object"]), row)
        with self.assertRaises(dt.Usage):
            plan.explain("floor")

    def test_coverage_is_what_the_command_line_writes(self):
        file = self.folder / "coverage.csv"
        self.assertEqual(run("plan", self.room, "--max-frames", 8, *SET, "--coverage", file).returncode,
                         0)
        ours = self.folder / "ours.csv"
        curves = self.plan.coverage(ours)
        self.assertEqual(ours.read_bytes(), file.read_bytes())
        last = file.read_text().split("\nlength")[0].strip().splitlines()[-1].split(",")
        self.assertEqual(curves["frames"]["frames"][-1], float(last[3]))
        self.assertEqual(len(curves["length"]["captured"]), len(curves["length"]["frames"]))

    # --- frames

    def test_frames_are_the_exported_images(self):
        names = ["rgb", "depth", "instance", "semantic", "albedo", "normal_world", "normal_camera",
                 "rgb_right", "depth_right"]
        folder = self.folder / "images"
        self.plan.export(folder, modalities=names, range="::2")
        with self.plan.render(*names, range="::2") as frames:
            self.assertEqual(len(frames), 4)
            drawn = list(frames)
        self.assertEqual([frame.index for frame in drawn], [0, 2, 4, 6])
        for number, frame in enumerate(drawn):
            np.testing.assert_allclose(frame.pose, self.plan.poses[frame.index], atol=1e-12)
            read = {name: cv2.imread(str(folder / name / f"{number:06d}.png"), cv2.IMREAD_UNCHANGED)
                    for name in names}
            for name in ("rgb", "albedo", "rgb_right"):
                np.testing.assert_array_equal(frame[name], read[name][:, :, ::-1])
            for name in ("depth", "depth_right"):
                self.assertEqual(frame[name].dtype, np.float32)
                np.testing.assert_array_equal(np.floor(frame[name] * 1000 + 0.5), read[name])
            for name in ("instance", "semantic"):
                np.testing.assert_array_equal(frame[name], read[name])
            seen = frame["depth"] > 0
            for name in ("normal_world", "normal_camera"):
                np.testing.assert_allclose(frame[name][seen],
                                           read[name][:, :, ::-1][seen] / 65535 * 2 - 1, atol=2e-3)

    def test_licences_beside_the_scene_are_exported(self):
        scene, out = self.folder / "licensed", self.folder / "licensed_dataset"
        scene.mkdir()
        tiny_room.write(scene / "room.obj")
        (scene / "LICENSE.md").write_text("CC-BY 4.0\n")
        dt.load(scene / "room.obj").plan(max_frames=2, **SIZE).export(out, modalities=["depth"])
        self.assertEqual((out / "LICENSES").read_bytes(), b"CC-BY 4.0\n")
        listed = json.loads((out / "dataset.json").read_text())["files"]
        self.assertEqual(listed, {name: sha256 for name, sha256 in hashes(out).items()
                                  if name != "dataset.json"})

    def test_path_traced_frames_have_layers_of_light(self):
        names = ["hdr", "diffuse_reflectance", "diffuse_illumination", "residual"]
        frame = next(iter(self.plan.render(*names, range="0:1", render_mode="traced",
                                           traced_samples=2)))
        hdr, reflectance, illumination, residual = (frame[name] for name in names)
        self.assertEqual((hdr.dtype, hdr.shape[2]), (np.float32, 3))
        np.testing.assert_allclose(reflectance * illumination + residual, hdr, atol=1e-4)
        self.assertGreater(hdr.mean(), 0.05)
        with self.assertRaisesRegex(dt.Usage, "render_mode=traced"):
            self.plan.render("hdr")

    def test_depth_pose_and_intrinsics_lead_to_the_objects_box(self):
        table, found = self.scene["table"], 0
        for frame in self.plan.render("depth", "instance"):
            v, u = np.nonzero(frame["instance"] == table.id)
            pixels = np.stack([u + 0.5, v + 0.5, np.ones(len(u))])
            rays = np.linalg.inv(self.plan.intrinsics) @ pixels
            points = frame.pose[:3, :3] @ (rays * frame["depth"][v, u]) + frame.pose[:3, 3:]
            low, high = table.corners.min(axis=0), table.corners.max(axis=0)
            self.assertTrue((points.T > low - 2e-3).all() and (points.T < high + 2e-3).all())
            found += len(u)
        self.assertGreater(found, 100)

    def test_frames_end_when_they_are_closed(self):
        frames = self.plan.render("instance")
        first = next(frames)
        kept = first["instance"].copy()
        frames.close()
        frames.close()
        self.assertEqual(list(frames), [])
        del frames
        gc.collect()
        np.testing.assert_array_equal(first["instance"], kept)

    # --- datasets

    def test_exports_have_the_command_lines_bytes(self):
        ours, theirs, resaved = (self.folder / name for name in ("ours", "theirs", "resaved"))
        options = ["--folds", 2, "--modalities", "all", "--formats", "all", "--set",
                   "light_preset=day"]
        done = run("export", self.room, "--out", theirs, "--max-frames", 8, *SET, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        asked = {"modalities": "all", "formats": "all", "folds": 2, "light_preset": "day"}
        summary = self.plan.export(ours, **asked)
        self.assertEqual(summary["frames"], 8)
        self.assertSameFiles(ours, theirs)
        project = self.folder / "saved.dolly"
        self.plan.save(project)
        self.assertEqual(run("export", project, "--out", resaved, *options).returncode, 0)
        self.assertSameFiles(ours, resaved)
        again = self.folder / "again"
        dt.load(project).saved_plan().export(again, **asked)
        self.assertSameFiles(ours, again)

    def test_a_preset_is_the_command_lines(self):
        ours, theirs = self.folder / "preset_a", self.folder / "preset_b"
        done = run("export", self.room, "--out", theirs, "--max-frames", 8, *SET, "--preset", "nerf",
                   "--formats", "colmap")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.plan.export(ours, preset="nerf", formats="colmap")
        self.assertSameFiles(ours, theirs)
        with self.assertRaisesRegex(dt.Usage, "did you mean 'nerf'"):
            self.plan.export(self.folder / "none", preset="nerv")

    def test_rooms_become_datasets_of_their_own(self):
        two = self.folder / "two.obj"
        tiny_room.write_two(two)
        done = run("export", two, "--out", self.folder / "two_a", "--max-frames", 8, *SET, "--set",
                   "rooms=each")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = dt.load(two).plan(max_frames=8, rooms="each", **SIZE).export(self.folder / "two_b")
        self.assertEqual([room["room"] for room in summary["rooms"]], ["room_1", "room_2"])
        self.assertSameFiles(self.folder / "two_a", self.folder / "two_b")

    def test_other_files_are_left_alone(self):
        folder = self.folder / "mine"
        folder.mkdir()
        (folder / "notes.txt").write_text("mine")
        with self.assertRaises(dt.CannotWrite) as caught:
            self.plan.export(folder)
        refused = run("export", self.room, "--out", folder, "--max-frames", 8, *SET)
        self.assertEqual(refused.returncode, caught.exception.exit_code)
        said = refused.stderr.strip().splitlines()[-1].replace("--overwrite", "overwrite=True")
        self.assertEqual(f"dollytrack: {caught.exception}", said)

    # --- judging

    def test_a_judged_trajectory_has_its_planners_figures(self):
        judged = dt.judge(self.scene, self.plan.poses, self.plan.times, self.plan.paths, **SIZE)
        self.assertEqual(judged["frames"], len(self.plan))
        self.assertEqual(judged["captured"], self.plan.metrics["captured"])
        self.assertEqual(judged["well_captured"], self.plan.metrics["well_captured"])
        steps = np.linalg.norm(np.diff(self.plan.poses[:, :3, 3], axis=0), axis=1)
        self.assertAlmostEqual(judged["path_length_m"], steps.sum(), places=6)
        outside = np.repeat(np.eye(4)[None], 5, axis=0)
        outside[:, :3, 3] = (50, 50, 1)
        far = dt.judge(self.scene, outside, **SIZE)
        self.assertEqual((far["captured"], far["outside_rate"]), (0, 1.0))

    def test_judge_refuses_parameters_that_it_does_not_use(self):
        poses = self.plan.poses
        for name, value in (("frame_rate", 2), ("fps", 2)):
            with self.assertRaisesRegex(dt.Usage, f"^{name}: .*argument times"):
                dt.judge(self.scene, poses, **{name: value})
        for name, value in (("fill", 0.5), ("max_frames", 3), ("seed", 2), ("exposure_ev", 1)):
            with self.assertRaisesRegex(dt.Usage, f"^{name}: .*body, camera, free_space"):
                dt.judge(self.scene, poses, **{name: value})

    def test_paths_are_integers(self):
        poses = self.plan.poses
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for paths in (np.arange(8) + 0.5, np.full(8, np.nan), np.full(8, np.inf),
                          np.arange(8) * 2**40, np.full(8, 2**63, np.uint64)):
                with self.assertRaisesRegex(dt.Usage, r"^paths\[\d\]: "):
                    dt.judge(self.scene, poses, paths=paths)
            cut = np.array([0, 0, 0, 0, 1, 1, 1, 1])
            self.assertEqual(dt.judge(self.scene, poses, paths=cut.astype(np.float32)),
                             dt.judge(self.scene, poses, paths=cut))

    # --- errors

    def test_unknown_names_are_compared_with_arguments_and_parameters(self):
        for call, text in (
                (lambda: self.plan.export("x", format="yolo"), "did you mean 'formats'"),
                (lambda: self.plan.export("x", modality="rgb"), "did you mean 'modalities'"),
                (lambda: self.plan.render("rgb", light_prest="day"), "did you mean 'light_preset'"),
                (lambda: self.scene.plan(ignor="sofa"), "did you mean 'ignore'"),
                (lambda: self.scene.plan(fps=2), "did you mean 'frame_rate'"),
                (lambda: dt.judge(self.scene, self.plan.poses, tims=[1]), "did you mean 'times'"),
                (lambda: self.plan.render("rgb", widht_px=64), r"did you mean 'width_px'\?.*plan\(\)"),
                (lambda: self.plan.render(images="rgb"), "without a name"),
                (lambda: self.plan.export("x", qqqq=1), r"'qqqq'; dollytrack.parameters\(\) lists all"),
                (lambda: self.plan.render("rgb", width_px=64), r"^width_px: .*plan\(\).*imu, stereo"),
                (lambda: self.plan.export("x", fill=0.5), r"^fill: .*plan\(\).*imu, stereo")):
            with self.subTest(text), self.assertRaisesRegex(dt.Usage, text):
                call()

    def test_the_names_of_images_are_checked(self):
        for name, text in (("RGB", "did you mean 'rgb'"), ("color", "did you mean 'rgb'"),
                           ("dept", "did you mean 'depth'"), ("xyz", "There is no image 'xyz'; there are"),
                           ("tracks", r"export\(\) writes it"), (["rgb"], r"render\('rgb', 'depth'\)"),
                           ("rgb, depth", r"render\('rgb', 'depth'\)")):
            with self.subTest(name), self.assertRaisesRegex(dt.Usage, text):
                self.plan.render(name)
        # The list of the types is the engine's.
        with self.assertRaises(dt.Usage) as caught:
            self.plan._core.render(modalities=["xyz"], range="::", still=False, gl="auto",
                                   assignments=[], progress=None)
        known = ", ".join(typing.get_args(plan_module.ImageName))
        self.assertIn(f"render() has {known};", str(caught.exception))

    def test_names_are_given_as_a_list(self):
        for given, text in (({"modalities": "rgb, depth"}, r"\['rgb', 'depth'\]"),
                            ({"formats": "coco,yolo"}, r"\['coco', 'yolo'\]"),
                            ({"modalities": []}, "empty"), ({"formats": ()}, "empty"),
                            ({"modalities": 3}, "int"), ({"flow_distances": 2.5}, "whole number")):
            with self.subTest(given), self.assertRaisesRegex(dt.Usage, f"^{[*given][0]}: .*{text}"):
                self.plan.export(self.folder / "none", **given)

    def test_one_distance_of_flow_is_a_list_of_one(self):
        for name, distances in (("flow_a", 3), ("flow_b", [3]), ("flow_c", np.int64(3))):
            self.plan.export(self.folder / name, modalities="flow_forward", flow_distances=distances)
        self.assertSameFiles(self.folder / "flow_a", self.folder / "flow_b")
        self.assertSameFiles(self.folder / "flow_a", self.folder / "flow_c")

    def test_the_unit_is_a_positive_number(self):
        for unit in (0, -1, float("nan"), float("inf"), 1e30, 10**400):
            with self.subTest(unit), self.assertRaisesRegex(dt.Usage, "^unit_m: "):
                dt.load(self.room, unit_m=unit)

    def test_errors_have_the_command_lines_sentences_and_codes(self):
        damaged = self.folder / "damaged.glb"
        damaged.write_bytes(b"glTF nonsense")
        out = self.folder / "refused"
        for arguments, call in (
                (["info", self.folder / "missing.obj"], lambda: dt.load(self.folder / "missing.obj")),
                (["info", damaged], lambda: dt.load(damaged)),
                (["plan", self.room, "--set", "fil=0.5"], lambda: self.scene.plan(fil=0.5)),
                (["plan", self.room, "--set", "fill=7"], lambda: self.scene.plan(fill=7)),
                (["plan", self.room, "--set", "fill=nan"], lambda: self.scene.plan(fill=float("nan"))),
                (["plan", self.room, "--set", "rooms=eech"], lambda: self.scene.plan(rooms="eech")),
                (["plan", self.room, "--ignore", "sofas"], lambda: self.scene.plan(ignore="sofas")),
                (["plan", self.room, "--set", "camera_radius_m=2"],
                 lambda: self.scene.plan(camera_radius_m=2)),
                (["export", self.room, "--out", out, "--modalities", "rbg"],
                 lambda: self.plan.export(out, modalities="rbg")),
                (["export", self.room, "--out", out, "--range", "x"],
                 lambda: self.plan.export(out, range="x"))):
            with self.assertRaises(dt.Error) as caught:
                call()
            refused = run(*arguments)
            # These options have the names of the arguments.
            self.assertEqual(f"dollytrack: {caught.exception}",
                             refused.stderr.strip().splitlines()[-1].replace("--", ""))
            self.assertEqual(caught.exception.exit_code, refused.returncode, caught.exception)
        with self.assertRaisesRegex(dt.Usage, "plan()"):
            self.plan.export(out, fill=0.5)
        with self.assertRaisesRegex(dt.Usage, "export"):
            self.plan.render("flow_forward")

    def test_messages_name_arguments_instead_of_options(self):
        for text, wanted in (
                ("too small; try --unit 0.52", "too small; try unit_m=0.52"),
                ("try --up -y", 'try up_axis="-y"'), ("pass --up if it", "pass up_axis if it"),
                ("(--keep-meshes leaves them)", "(keep_meshes=True leaves them)"),
                ("add --set fill=0.5", "add fill=0.5"), ("--flow-distances", "flow_distances"),
                ("'dollytrack export --resume' finishes it", "'dollytrack export --resume' finishes it")):
            self.assertEqual(errors.in_python(text), wanted)
        with self.assertRaisesRegex(dt.Usage, "0.01 for cm"):
            dt.load(self.room, unit_m="cm")

    def test_scenes_and_plans_say_how_other_processes_get_them(self):
        with self.assertRaisesRegex(TypeError, "saved_plan"):
            pickle.dumps(self.plan)
        with self.assertRaisesRegex(TypeError, "load its file"):
            pickle.dumps(self.scene)

    def test_the_progress_of_an_export_ends_at_one(self):
        seen = []
        self.plan.export(self.folder / "progress", range="0:2",
                         progress=lambda fraction, stage: seen.append(fraction))
        self.assertEqual(seen[-1], 1.0)
        self.assertEqual(seen, sorted(seen))

    def test_rendered_pixels_without_a_class_have_the_void_id(self):
        labels = self.folder / "labels.json"
        labels.write_text(json.dumps({"classes": [{"id": 0, "name": "table", "matches": ["table"]}]}))
        scene = dt.load(self.room, labels=labels)
        self.assertEqual((self.scene.void_id, scene.void_id, scene.classes), (0, 255, {0: "table"}))
        table = scene["table"].id
        for frame in scene.plan(max_frames=3, **SIZE).render("semantic", "instance"):
            np.testing.assert_array_equal(frame["semantic"], np.where(frame["instance"] == table, 0, 255))

    def test_a_modality_asked_for_twice_is_one_image(self):
        [frame] = self.plan.render("rgb", "rgb", range="0:1")
        [once] = self.plan.render("rgb", range="0:1")
        np.testing.assert_array_equal(frame["rgb"], once["rgb"])

    def test_files_that_are_there_are_not_overwritten(self):
        vertices, faces, ids = arrays()
        taken = self.folder / "taken.glb"
        taken.with_name("taken.glb.objects.json").write_text("{}")
        with self.assertRaises(dt.CannotWrite):
            dt.Scene.from_arrays(vertices, faces, ids, file=taken)
        self.assertFalse(taken.exists())
        self.assertIn("mug", self.scene)
        self.assertEqual(len(list(self.scene)), len(self.scene))

    def test_the_examples_run(self):
        environment = {**os.environ, "PYTHONPATH": MODULE}
        examples = ROOT / "app" / "python" / "examples"
        wanted = [("tune_a_plan.py", [self.folder / "best.dolly", self.folder / "coverage.png"],
                   "captured well")]
        if HAS_TORCH:
            wanted.append(("room_to_dataloader.py", [self.folder / "loader"], "boxes"))
        for name, arguments, word in wanted:
            done = subprocess.run([sys.executable, examples / name, self.room, *arguments],
                                  capture_output=True, text=True, env=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(word, done.stdout)
        self.assertIsNotNone(cv2.imread(str(self.folder / "coverage.png")))

    def test_the_guides_first_example_runs(self):
        if not HAS_TORCH:
            self.skipTest("PyTorch is not installed")
        guide = (ROOT / "app" / "guides" / "python.md").read_text()
        code = guide.split("```python\n")[1].split("```")[0]
        place = self.folder / "guide"
        place.mkdir()
        export = "import dollytrack as dt; dt.load({!r}).plan(max_frames=9, width_px=64, height_px=48)"
        process = start_python(export.format(str(self.room)) + ".save('room.dolly')\n"
                               + code.replace('dt.load("room.glb").plan(max_frames=300)',
                                              'dt.load("room.dolly").saved_plan()'), cwd=place)
        out, errors = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(len(out.strip().splitlines()), 2)


if __name__ == "__main__":
    unittest.main()
