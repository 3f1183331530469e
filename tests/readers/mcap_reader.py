"""Foxglove's libraries read the recordings that `gather --format mcap` makes."""
import json
import pathlib
import subprocess
import unittest
import zlib

import yaml

import exports
import recording_case

HERE = pathlib.Path(__file__).parent
DUMP = HERE / "mcap_dump.js"


class Mcap(recording_case.Recording, unittest.TestCase):
    FORMAT = "mcap"

    @staticmethod
    def read(path, *selection):
        return json.loads(exports.call("node", DUMP, path, *selection))

    @classmethod
    def setUpClass(cls):
        exports.need_program("node", "nodejs")
        if not (HERE / "node_modules" / "@mcap" / "core").exists():
            exports.missing("@mcap/core", f"it by: npm ci --prefix {HERE}")
        cls.record()

    def test_definitions_are_those_of_ros(self):
        names = set()
        for one in self.all["definitions"]:
            names.add(one["name"])
            if one["official"] is None:  # these are built into the library
                self.assertIn(one["name"], ["builtin_interfaces/Time", "builtin_interfaces/Duration"])
            else:
                self.assertEqual(one["own"], one["official"], one["name"])
        for name in ["sensor_msgs/CameraInfo", "sensor_msgs/Imu", "visualization_msgs/Marker",
                     "geometry_msgs/TransformStamped", "sensor_msgs/CompressedImage"]:
            self.assertIn(name, names)

    def test_header_statistics_and_order(self):
        records = {one["type"]: one for one in self.all["others"]}
        self.assertEqual(records["Header"]["profile"], "ros2")
        self.assertEqual({one["messageEncoding"] for one in self.all["channels"]}, {"cdr"})
        self.assertEqual({one["encoding"] for one in self.all["schemas"]}, {"ros2msg"})
        times = [int(one["log"]) for one in self.all["messages"]]
        self.assertEqual(times, sorted(times))
        self.assertEqual(times, [int(one["publish"]) for one in self.all["messages"]])
        statistics = records["Statistics"]
        self.assertEqual(int(statistics["messageCount"]), len(times))
        self.assertEqual([int(statistics["messageStartTime"]), int(statistics["messageEndTime"])],
                         [times[0], times[-1]])
        self.assertEqual(statistics["attachmentCount"], 1)
        topics = {one["id"]: one["topic"] for one in self.all["channels"]}
        for channel, count in statistics["channelMessageCounts"].items():
            self.assertEqual(int(count), len(self.messages(topics[int(channel)])))
        self.assertGreater(statistics["chunkCount"], 3)
        # The checksum of the data section, which the library does not check.
        data = self.file.read_bytes()
        end = int(records["Footer"]["summaryStart"]) - 13  # where the record DataEnd begins
        self.assertEqual(records["DataEnd"]["dataSectionCrc"], zlib.crc32(data[:end]))

    def test_every_topic_has_its_quality_of_service(self):
        found = {}
        for one in self.all["channels"]:
            (profile,) = yaml.safe_load(one["metadata"]["offered_qos_profiles"])
            found[one["topic"]] = profile["durability"]
        # 1, transient local: nodes that start later get the last message. 2: they do not.
        latched = {topic for topic, durability in found.items() if durability == 1}
        self.assertEqual(latched, {"/tf_static", "/objects", "/trajectory"})
        self.assertEqual(set(found.values()), {1, 2})

    def test_dataset_json_and_classes_are_in_the_file(self):
        (attachment,) = self.all["attachments"]
        self.assertEqual((attachment["name"], attachment["mediaType"]),
                         ("dataset.json", "application/json"))
        (classes,) = [one["metadata"] for one in self.all["others"] if one["type"] == "Metadata"]
        self.check_description(attachment["text"], classes)

    def test_the_index_leads_to_the_messages_of_a_time(self):
        topic = "/camera/rgb/compressed"
        for index in (0, 3):
            found = self.read(self.file, self.times[index], self.times[index], topic)
            expected = [one for one in self.all["messages"]
                        if one["topic"] == topic and int(one["log"]) == self.times[index]]
            self.assertEqual(len(expected), 1)
            self.assertEqual(found["messages"], expected)
            self.assertLess(found["bytes_read"], 0.7 * self.file.stat().st_size)

    def test_a_changed_byte_is_found(self):
        data = self.file.read_bytes()
        rgb = (self.data.folder / "rgb" / "000003.png").read_bytes()
        summary = int(next(one for one in self.all["others"] if one["type"] == "Footer")["summaryStart"])
        changed = self.file.with_name("changed.mcap")
        for at, ask in [(data.index(rgb) + len(rgb) // 2, []),
                        (data.index(b'"length_unit"'), []),
                        (data.index(rgb) + len(rgb) // 2,
                         [self.times[3], self.times[3], "/camera/rgb/compressed"]),
                        (data.index(b"/camera/camera_info", summary), [0, 0, "/tf"])]:
            changed.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1:])
            done = subprocess.run(["node", DUMP, changed, *map(str, ask)], capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 1, at)
            self.assertIn("crc", done.stderr.lower())
        changed.unlink()
