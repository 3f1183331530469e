"""ffprobe and OpenCV read preview.mp4, which has the same frames as the dataset."""
import json
import unittest

import exports

MIN_PSNR = 28.0  # dB; two different frames have about 15


class Video(unittest.TestCase):
    def setUp(self):
        self.data = exports.film()
        self.path = self.data.folder / "preview.mp4"

    def test_ffprobe_tells_frames_size_and_rate(self):
        exports.need_program("ffprobe", "ffmpeg")
        shown = json.loads(exports.call(
            "ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", self.path))
        stream, = shown["streams"]
        self.assertEqual(int(stream["nb_read_frames"]), len(self.data.frames))
        self.assertEqual((stream["width"], stream["height"]), (self.data.width, self.data.height))
        over, under = map(int, stream["avg_frame_rate"].split("/"))
        self.assertAlmostEqual(over / under, 15, delta=0.02)
        self.assertEqual((stream["codec_name"], stream["pix_fmt"]), ("h264", "yuv420p"))

    def test_the_pictures_are_the_frames_in_their_order(self):
        try:
            import cv2
        except ImportError:
            exports.missing("OpenCV", "python3-opencv")
        video = cv2.VideoCapture(str(self.path))
        for i in range(len(self.data.frames)):
            found, picture = video.read()
            self.assertTrue(found, i)
            self.assertGreater(cv2.PSNR(picture, cv2.imread(self.data.file("rgb", i))), MIN_PSNR, i)
        self.assertFalse(video.read()[0])
