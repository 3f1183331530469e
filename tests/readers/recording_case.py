"""Recordings that `gather` makes for ROS: all that a reader decodes must be the dataset's."""
import csv
import functools
import hashlib
import json
import shutil
import subprocess

import numpy as np

import exports

RIG = ["--camera", "wide:lens=fisheye,k1=-0.02,k2=0.003,width_px=320,height_px=320,right_m=0.1,yaw_deg=-30",
       "--camera", "front-left:width_px=160,height_px=120,right_m=-0.05",
       "--camera", "around:lens=equirectangular,level=true,width_px=256,height_px=128"]
# Topic and frame of each camera of the rig.
RIG_FRAMES = {"wide": "camera_wide", "front-left": "camera_front_left", "around": "camera_around"}


def stamp_ns(stamp):
    return stamp["sec"] * 1_000_000_000 + stamp["nanosec"]


def matrix_of(position, xyzw):
    matrix = np.eye(4)
    matrix[:3, :3] = exports.rotation(xyzw)
    matrix[:3, 3] = position
    return matrix


def vector(message):
    return [message[key] for key in "xyzw" if key in message]


@functools.cache
def recorded():
    return exports.Dataset("recorded", "--range", "0:120:30", "--set", "jpeg_quality=90", *RIG)


class Recording:
    """Tests of a recording's content. A class that inherits them has FORMAT, the layout, and
    read(), which returns the messages and channels of a file."""

    @classmethod
    def record(cls):
        try:
            global cv2
            import cv2
        except ImportError:
            exports.missing("OpenCV", "python3-opencv")
        cls.data = recorded()
        cls.file = cls.gather(cls.data.folder)
        cls.all = cls.read(cls.file)
        cls.times = [round(frame["time_s"] * 1e9) for frame in cls.data.frames]

    @classmethod
    def gather(cls, dataset):
        out = dataset.with_name(f"{dataset.name}_{cls.FORMAT}")
        exports.dollytrack("-q", "gather", dataset, "--out", out, "--format", cls.FORMAT)
        (file,) = (out / "train").iterdir()
        return file

    def messages(self, topic):
        found = [one["message"] for one in self.all["messages"] if one["topic"] == topic]
        self.assertTrue(found, topic)
        return found

    def static_transforms(self):
        """Pose of each child frame in the planned camera's frame."""
        (message,) = self.messages("/tf_static")
        found = {}
        for one in message["transforms"]:
            self.assertEqual(one["header"]["frame_id"], "camera_optical_frame")
            found[one["child_frame_id"]] = matrix_of(
                vector(one["transform"]["translation"]), vector(one["transform"]["rotation"]))
        return found

    def check_description(self, dataset_json, classes):
        card = dict(self.data.card)
        del card["files"]
        card["scene"] = {key: value for key, value in card["scene"].items() if key != "path"}
        self.assertEqual(json.loads(dataset_json), card)
        self.assertEqual(classes, {str(one["id"]): one["name"] for one in card["classes"][1:]})

    # --- images

    def image_folders(self):
        """Folder -> (topic, frame) of all PNG and JPEG images of the dataset."""
        found = {}
        for folder in self.data.card["modalities"]:
            if not list((self.data.folder / folder).glob("000000.[pj][np]g")):
                continue
            camera, image = "camera", folder
            if folder.endswith("_right"):
                camera, image = "right_camera", folder.removesuffix("_right")
            if folder == "rgb_sensor":
                camera, image = "sensor_camera", "rgb"
            transport = "compressedDepth" if folder.startswith("depth") else "compressed"
            frame = "camera" if camera == "sensor_camera" else camera
            found[folder] = (f"/{camera}/{image}/{transport}", frame)
        for name, camera in RIG_FRAMES.items():
            for image in ["rgb", "depth", "instance", "semantic", "normal_world"]:
                planar = image == "depth" and name == "front-left"
                transport = "compressedDepth" if planar else "compressed"
                found[f"cameras/{name}/{image}"] = (f"/{camera}/{image}/{transport}", camera)
        return found

    def test_images_are_the_files(self):
        folders = self.image_folders()
        self.assertLessEqual({"rgb", "depth", "semantic", "instance", "rgb_right", "rgb_sensor"},
                             set(folders))
        written = {one["topic"] for one in self.all["channels"] if "/compressed" in one["topic"]}
        self.assertEqual(written, {topic for topic, _ in folders.values()})
        by_topic = {one["topic"]: one for one in self.all["channels"]}
        for folder, (topic, frame) in folders.items():
            files = sorted(path for path in (self.data.folder / folder).iterdir()
                           if path.stem.isdigit())
            messages = self.messages(topic)
            self.assertEqual(len(messages), len(files))
            self.assertEqual(by_topic[topic]["metadata"]["folder"], folder)
            for path, message, time in zip(files, messages, self.times):
                self.assertEqual(stamp_ns(message["header"]["stamp"]), time)
                self.assertEqual(message["header"]["frame_id"], frame + "_optical_frame")
                data, bytes_ = message["data"], path.read_bytes()
                sha256 = hashlib.sha256(bytes_).hexdigest()
                if topic.endswith("compressedDepth"):
                    self.assertEqual(message["format"], "16UC1; compressedDepth png")
                    self.assertEqual(data["first"], [0] * 12)
                    self.assertEqual(data["sha256_behind_first"], sha256)
                    continue
                self.assertEqual(data["sha256"], sha256)
                pixels = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
                expected = "jpeg" if path.suffix == ".jpg" else "png"
                if pixels.dtype == np.uint16:
                    expected = ("mono16; png compressed " if pixels.ndim == 2
                                else "rgb16; png compressed bgr16")
                self.assertEqual(message["format"], expected)
        self.assertEqual(self.messages("/sensor_camera/rgb/compressed")[0]["format"], "jpeg")

    # --- cameras and poses

    def test_poses_of_the_cameras(self):
        around = next(one for one in self.data.card["cameras"] if one["name"] == "around")
        for index, message in enumerate(self.messages("/tf")):
            poses = {one["child_frame_id"]: one for one in message["transforms"]}
            self.assertEqual(set(poses), {"camera_optical_frame", "camera_around_optical_frame"})
            for frame, expected in [("camera_optical_frame", self.data.frames[index]),
                                    ("camera_around_optical_frame", around["poses"][index])]:
                self.assertEqual(poses[frame]["header"]["frame_id"], "map")
                self.assertEqual(stamp_ns(poses[frame]["header"]["stamp"]), self.times[index])
                transform = poses[frame]["transform"]
                np.testing.assert_allclose(
                    matrix_of(vector(transform["translation"]), vector(transform["rotation"])),
                    matrix_of(expected["position"], expected["quaternion_xyzw"]), atol=1e-12)
        self.assertEqual(index + 1, len(self.times))
        (path,) = self.messages("/trajectory")
        np.testing.assert_allclose([vector(one["pose"]["position"]) for one in path["poses"]],
                                   [one["position"] for one in self.data.frames], atol=1e-12)
        self.assertEqual([stamp_ns(one["header"]["stamp"]) for one in path["poses"]], self.times)

    def test_the_planned_camera_has_the_lens_of_the_dataset(self):
        data = self.data
        for message, time in zip(self.messages("/camera/camera_info"), self.times):
            self.assertEqual((message["width"], message["height"]), (data.width, data.height))
            self.assertEqual(stamp_ns(message["header"]["stamp"]), time)
            k = [data.fx, 0, data.cx - 0.5, 0, data.fy, data.cy - 0.5, 0, 0, 1]
            self.assertEqual(message["k"], k)
            np.testing.assert_array_equal(np.reshape(message["p"], (3, 4))[:, :3].ravel(), k)
            self.assertEqual(message["r"], np.eye(3).ravel().tolist())
            self.assertEqual((message["distortion_model"], message["d"]), ("plumb_bob", [0] * 5))
        sensor = self.messages("/sensor_camera/camera_info")[0]
        bent = data.card["conventions"]["rgb_sensor"]["distortion"]
        self.assertEqual(sensor["d"], [bent[key] for key in ("k1", "k2", "p1", "p2", "k3")])
        self.assertEqual(sensor["k"], k)
        # ROS has no model of a panorama.
        self.assertNotIn("/camera_around/camera_info",
                         {one["topic"] for one in self.all["channels"]})

    def seen_points(self, index):
        """Pixels with depth, and their points in the planned camera's frame."""
        depth = cv2.imread(self.data.file("depth", index), cv2.IMREAD_UNCHANGED) / 1000.0
        k = np.reshape(self.messages("/camera/camera_info")[index]["k"], (3, 3))
        rows, columns = (axis.ravel() for axis in np.mgrid[5:self.data.height:10,
                                                          5:self.data.width:10])
        z = depth[rows, columns]
        rows, columns, z = rows[z > 0], columns[z > 0], z[z > 0]
        rays = np.linalg.inv(k) @ [columns, rows, np.ones(len(z))]
        return rows, columns, (rays * z).T

    def test_the_stereo_camera_sees_the_disparity(self):
        disparity = cv2.imread(self.data.file("disparity", 0), cv2.IMREAD_UNCHANGED) / 256.0
        rows, columns, points = self.seen_points(0)
        shifts = disparity[rows, columns]
        used = shifts > 0
        p = np.reshape(self.messages("/right_camera/camera_info")[0]["p"], (3, 4))
        by_matrix = np.c_[points, np.ones(len(points))] @ p.T
        right = self.static_transforms()["right_camera_optical_frame"]
        by_transform = (points - right[:3, 3]) @ right[:3, :3] @ p[:, :3].T
        self.assertGreater(used.sum(), 500)
        for image in (by_matrix, by_transform):
            error = columns - image[:, 0] / image[:, 2] - shifts
            self.assertLess(np.abs(error[used]).max(), 0.1)  # depth has steps of 1 mm
            np.testing.assert_allclose(image[:, 1] / image[:, 2], rows, atol=1e-6)

    def test_the_cameras_of_the_rig_see_the_same_points(self):
        """Points of the planned camera's depth image, seen by the cameras of the rig."""
        static = self.static_transforms()
        for name, camera in RIG_FRAMES.items():
            if name == "around":
                continue
            hits = 0
            for index in range(len(self.times)):
                _, _, points = self.seen_points(index)
                pose = static[camera + "_optical_frame"]
                points = (points - pose[:3, 3]) @ pose[:3, :3]
                info = self.messages(f"/{camera}/camera_info")[index]
                k, d = np.reshape(info["k"], (3, 3)).astype(float), np.array(info["d"], float)
                points = points[points[:, 2] > 0.05]
                if info["distortion_model"] == "equidistant":
                    pixels, _ = cv2.fisheye.projectPoints(points[:, None], np.zeros(3), np.zeros(3),
                                                          k, d)
                    expected = np.linalg.norm(points, axis=1)
                else:
                    pixels, _ = cv2.projectPoints(points[:, None], np.zeros(3), np.zeros(3), k, d)
                    expected = points[:, 2]
                depth = cv2.imread(self.data.file(f"cameras/{name}/depth", index),
                                   cv2.IMREAD_UNCHANGED) / 1000.0
                self.assertEqual(depth.shape, (info["height"], info["width"]))
                x, y = np.round(pixels[:, 0]).astype(int).T
                inside = (x >= 0) & (y >= 0) & (x < info["width"]) & (y < info["height"])
                error = np.abs(depth[y[inside], x[inside]] - expected[inside]) / expected[inside]
                hits += inside.sum()
                self.assertLess(np.median(error), 0.01, name)
            self.assertGreater(hits, 3000, name)

    # --- measurements and objects

    def test_inertial_measurements(self):
        with open(self.data.folder / "imu.csv", newline="") as file:
            rows = [list(map(float, row)) for row in list(csv.reader(file))[1:]]
        messages = self.messages("/imu")
        self.assertEqual(len(messages), len(rows))
        for message, row in zip(messages, rows):
            self.assertEqual(message["header"]["frame_id"], "imu_frame")
            self.assertEqual([stamp_ns(message["header"]["stamp"]),
                              *vector(message["angular_velocity"]),
                              *vector(message["linear_acceleration"])], row)
            self.assertEqual(message["orientation_covariance"][0], -1)  # no orientation
        np.testing.assert_array_equal(self.static_transforms()["imu_frame"], np.eye(4))

    def copy_as(self, name):
        copy = self.data.folder.with_name(name)
        shutil.copytree(self.data.folder, copy)
        return copy, json.loads((copy / "dataset.json").read_text())

    def test_a_damaged_rig_is_refused(self):
        copy, card = self.copy_as("short_rig_" + self.FORMAT)
        del card["cameras"][1]["poses"][-1]
        (copy / "dataset.json").write_text(json.dumps(card))
        done = subprocess.run([exports.PROGRAM, "-q", "gather", copy, "--out",
                               copy.with_name("no_recordings"), "--format", self.FORMAT],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 4)
        for words in [str(copy / "dataset.json"), "cameras[1] has 3 poses", "export the dataset again"]:
            self.assertIn(words, done.stderr)

    def test_a_moved_object_has_its_box_in_each_frame(self):
        copy, card = self.copy_as("moved_" + self.FORMAT)
        item = next(one for one in card["objects"] if one["role"] == "target")
        quarter = [0, 0, 0.5 ** 0.5, 0.5 ** 0.5]
        card["frames"][2]["moving"] = [
            {"object_id": item["id"], "position": [1, 2, 3], "quaternion_xyzw": quarter}]
        (copy / "dataset.json").write_text(json.dumps(card))
        found = self.read(self.gather(copy))["messages"]
        # The last message of each topic, which late readers get, has all boxes of the topic.
        (fixed,) = [one for one in found if one["topic"] == "/objects"]
        self.assertEqual({one["id"] for one in fixed["message"]["markers"]},
                         {one["id"] for one in card["objects"]} - {item["id"]})
        moving = [one for one in found if one["topic"] == "/moving_objects"]
        self.assertEqual(len(moving), len(self.times))
        x, y, z = item["box"]["center"]
        for index, one in enumerate(moving):
            (marker,) = one["message"]["markers"]
            self.assertEqual(stamp_ns(marker["header"]["stamp"]), self.times[index])
            self.assertEqual((marker["id"], marker["text"]), (item["id"], item["name"]))
            position, yaw = [x, y, z], item["box"]["yaw_rad"]
            if index == 2:
                position, yaw = [1 - y, 2 + x, 3 + z], yaw + np.pi / 2
            np.testing.assert_allclose(vector(marker["pose"]["position"]), position, atol=1e-9)
            np.testing.assert_allclose(exports.rotation(vector(marker["pose"]["orientation"]))[:, 0],
                                       [np.cos(yaw), np.sin(yaw), 0], atol=1e-9)

    def test_boxes_of_the_objects(self):
        self.assertNotIn("/moving_objects", {one["topic"] for one in self.all["channels"]})
        (message,) = self.messages("/objects")
        objects = self.data.card["objects"]
        classes = {one["id"]: one["name"] for one in self.data.card["classes"]}
        self.assertEqual(len(message["markers"]), len(objects))
        for marker, item in zip(message["markers"], objects):
            self.assertEqual((marker["header"]["frame_id"], marker["type"], marker["action"]),
                             ("map", 1, 0))
            self.assertEqual((marker["id"], marker["text"]), (item["id"], item["name"]))
            self.assertEqual(marker["ns"], item["role"] + "/" + classes[item["nyu40"]])
            self.assertEqual(vector(marker["pose"]["position"]), item["box"]["center"])
            np.testing.assert_allclose(vector(marker["scale"]), item["box"]["size"], atol=1e-12)
            yaw = item["box"]["yaw_rad"]
            np.testing.assert_allclose(exports.rotation(vector(marker["pose"]["orientation"]))[:, 0],
                                       [np.cos(yaw), np.sin(yaw), 0], atol=1e-12)
