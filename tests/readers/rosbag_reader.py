"""ROS 1's rosbag reads the recordings that `gather --format rosbag` makes."""
import collections
import hashlib
import io
import json
import subprocess
import unittest

import exports
import recording_case

CONVERTER = "/usr/lib/rosbag/encrypt"  # reads a bag and writes another in C++


def plain(value):
    """A message of genpy as the values that Foxglove's reader of ROS 2 makes."""
    if isinstance(value, genpy.TVal):
        return {"sec": value.secs, "nanosec": value.nsecs}
    if isinstance(value, genpy.Message):
        return {slot.lower(): plain(getattr(value, slot)) for slot in value.__slots__}
    if isinstance(value, bytes):
        return {"first": list(value[:12]), "sha256": hashlib.sha256(value).hexdigest(),
                "sha256_behind_first": hashlib.sha256(value[12:]).hexdigest()}
    return [plain(one) for one in value] if isinstance(value, (list, tuple)) else value


class Rosbag(recording_case.Recording, unittest.TestCase):
    FORMAT = "rosbag"

    @staticmethod
    def read(path, **selection):
        """Decodes the messages by the definitions in the bag."""
        messages, channels = [], {}
        with rosbag.Bag(str(path)) as bag:
            for one in bag.read_messages(return_connection_header=True, **selection):
                header = {key: value.decode() for key, value in one.connection_header.items()}
                channels[one.topic] = {"topic": one.topic, "metadata": header}
                messages.append({"topic": one.topic, "log": one.timestamp.to_nsec(),
                                 "message": plain(one.message)})
        return {"messages": messages, "channels": list(channels.values())}

    @classmethod
    def setUpClass(cls):
        try:
            global genpy, rosbag, roslib
            import genpy.dynamic
            import nav_msgs, sensor_msgs, tf2_msgs, visualization_msgs  # noqa: for roslib
            import rosbag
            import roslib.message
        except ImportError:
            exports.missing("rosbag or a package of messages", "python3-rosbag python3-nav-msgs "
                            "python3-sensor-msgs python3-tf2-msgs python3-visualization-msgs")
        cls.record()

    def by_topic(self, messages):
        found = collections.defaultdict(list)
        for one in messages:
            found[one["topic"]].append(one)
        return found

    def test_definitions_and_their_md5_sums_are_those_of_ros(self):
        names = set()
        for header in (one["metadata"] for one in self.all["channels"]):
            definitions = genpy.dynamic.generate_dynamic(header["type"],
                                                         header["message_definition"])
            self.assertEqual(header["md5sum"], definitions[header["type"]]._md5sum)
            for name, own in definitions.items():
                official = roslib.message.get_message_class(name)
                self.assertEqual(own._md5sum, official._md5sum, name)
                self.assertEqual((own.__slots__, own._slot_types),
                                 (official.__slots__, official._slot_types), name)
                names.add(name)
        for name in ["sensor_msgs/CameraInfo", "sensor_msgs/Imu", "visualization_msgs/Marker",
                     "geometry_msgs/TransformStamped", "sensor_msgs/CompressedImage"]:
            self.assertIn(name, names)
        other = header["message_definition"].replace("float64 x", "float32 x")
        self.assertNotEqual(
            genpy.dynamic.generate_dynamic(header["type"], other)[header["type"]]._md5sum,
            header["md5sum"])

    def test_messages_have_exactly_the_bytes_of_ros(self):
        with rosbag.Bag(str(self.file)) as bag:
            for topic, (name, data, *_), _ in bag.read_messages(raw=True):
                message = roslib.message.get_message_class(name)()
                message.deserialize(data)
                file = io.BytesIO()
                message.serialize(file)
                self.assertEqual(file.getvalue(), data, topic)

    def test_times_order_and_sequence(self):
        times = [one["log"] for one in self.all["messages"]]
        self.assertEqual(times, sorted(times))
        self.assertEqual((self.times[0], times[0]), (0, 1))  # rosbag in C++ drops messages at 0
        for topic, messages in self.by_topic(self.all["messages"]).items():
            for index, one in enumerate(messages):
                header = one["message"].get("header")
                if header is not None:
                    self.assertEqual(max(recording_case.stamp_ns(header["stamp"]), 1), one["log"])
                    self.assertEqual(header["seq"], index, topic)
        frames = [one["log"] for one in self.by_topic(self.all["messages"])["/tf"]]
        self.assertEqual(frames, [1, *self.times[1:]])

    def test_topics_for_late_nodes_are_latched(self):
        latched = {one["topic"] for one in self.all["channels"]
                   if one["metadata"].get("latching") == "1"}
        self.assertEqual(latched, {"/tf_static", "/objects", "/trajectory", "/dataset", "/classes"})

    def test_dataset_json_and_classes_are_in_the_file(self):
        (dataset,), (classes,) = self.messages("/dataset"), self.messages("/classes")
        self.check_description(dataset["data"], json.loads(classes["data"]))

    def test_the_index_leads_to_the_messages_of_a_time(self):
        topic = "/camera/rgb/compressed"
        expected = self.by_topic(self.all["messages"])[topic]
        for one in (expected[0], expected[3]):
            time = genpy.Time(nsecs=one["log"])
            found = self.read(self.file, topics=[topic], start_time=time, end_time=time)
            self.assertEqual(found["messages"], [one])

    def test_the_reader_in_cpp_finds_all_messages(self):
        exports.need_program(CONVERTER, "python3-rosbag")
        out = self.file.with_suffix(".converted")
        exports.call(CONVERTER, "-q", "-p", "rosbag/NoEncryptor", "--inbag", self.file, "-o", out)
        self.assertEqual(self.by_topic(self.read(out)["messages"]),
                         self.by_topic(self.all["messages"]))
        out.unlink()

    def test_a_truncated_bag_is_refused_and_can_be_indexed_again(self):
        cut = self.file.with_name("cut.bag")
        cut.write_bytes(self.file.read_bytes()[:self.file.stat().st_size * 2 // 3])
        with self.assertRaises(rosbag.ROSBagException):
            rosbag.Bag(str(cut))
        exports.call("rosbag", "reindex", "-f", "-q", cut)
        whole, found = (self.by_topic(self.read(path)["messages"]) for path in (self.file, cut))
        for topic, messages in found.items():
            self.assertEqual(messages, whole[topic][:len(messages)])
        self.assertGreaterEqual(len(found["/camera/rgb/compressed"]), 2)
        self.assertLess(len(found["/camera/rgb/compressed"]), len(self.times))
        for path in [cut, cut.with_name("cut.orig.bag")]:
            path.unlink()

    def test_a_changed_byte_is_found_by_its_hash(self):
        """A bag has no checksums."""
        data = self.file.read_bytes()
        rgb = (self.data.folder / "rgb" / "000003.png").read_bytes()
        at = data.index(rgb) + len(rgb) // 2
        out = self.file.parents[1]
        check = ["sha256sum", "-c", "SHA256SUMS"]
        exports.call(*check, cwd=out)
        self.addCleanup(self.file.write_bytes, data)
        self.file.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1:])
        changed = subprocess.run(check, cwd=out, capture_output=True, text=True)
        self.assertIn("train/recorded.bag: FAILED", changed.stdout)
        self.assertNotEqual(self.read(self.file), self.all)
