#!/usr/bin/python3
"""The page of `statistics` in a real browser; without one, the tests are skipped.

Usage: statistics_page_test.py PROGRAM [unittest arguments]
"""
import unittest

import cv2
import numpy as np

from statistics_case import HOSTILE, StatisticsCase
from support import browser

QUANTITIES = ["box_share", "mask_share", "aspect_ratio", "boxes_per_frame", "distance_m",
              "visible_fraction", "truncation", "best_visible_fraction", "camera_height_m",
              "camera_pitch_deg", "speed_mps", "turn_dps", "depth_m", "luma"]
CHARTS = sorted([*QUANTITIES, "boxes_by_class", "captured_by_class", "box_centers"])


class Page(StatisticsCase):
    @classmethod
    def setUpClass(cls):
        browser.need_browser()
        super().setUpClass()
        cls.pages = {}
        for name, datasets in (("one", [cls.whole]), ("two", [cls.whole, cls.part]),
                               ("hostile", [cls.hostile])):
            cls.pages[name] = cls.folder / f"{name}.html"
            cls.page_of(*datasets, "-o", cls.pages[name])
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def tearDown(self):
        self.browser.note_logs()
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([url for url in self.browser.requests
                          if not url.startswith(("file://", "data:", "about:"))], [])

    def open(self, name, **look):
        self.browser.look(**look)
        self.browser.open(self.pages[name])

    def charts(self):
        return sorted(self.browser.run("""return [...document.querySelectorAll(".chart")]
            .map(one => one.dataset.chart)"""))

    def test_all_charts_are_there(self):
        self.open("one")
        self.assertEqual(self.charts(), CHARTS)
        self.open("two")
        self.assertEqual(self.charts(), sorted([*CHARTS, "box_centers"]))
        self.open("hostile")  # without instances.csv
        self.assertEqual(self.charts(), [name for name in CHARTS
                                         if name not in ("visible_fraction", "truncation")])

    def test_every_chart_has_title_axes_and_marks(self):
        self.open("two")
        bare = self.browser.run("""return [...document.querySelectorAll(".chart")].filter(one =>
            !one.querySelector("h3").textContent || !one.querySelector("svg[aria-label]") ||
            !one.querySelector("svg .label") || one.querySelectorAll("svg text").length < 4 ||
            !one.querySelector("svg .bars, svg .line"))
            .map(one => one.dataset.chart)""")
        self.assertEqual(bare, [])
        colors = self.browser.run("""return [...document.querySelectorAll(
            "[data-chart=box_share] .line")].map(one => getComputedStyle(one).stroke)""")
        self.assertEqual(len(set(colors)), 2)

    def test_numbers_and_marks_stay_within_their_charts(self):
        self.open("two")
        outside = self.browser.run("""
            const out = [];
            for (const svg of document.querySelectorAll(".chart svg")) {
                const frame = svg.getBoundingClientRect();
                for (const one of svg.querySelectorAll("text, path, rect")) {
                    const box = one.getBoundingClientRect();
                    if (box.left < frame.left - 2 || box.right > frame.right + 2 ||
                        box.top < frame.top - 2 || box.bottom > frame.bottom + 2)
                        out.push([svg.getAttribute("aria-label"), one.textContent]);
                }
            }
            return out;""")
        self.assertEqual(outside, [])

    def test_the_page_fits_phones_and_desks_in_both_schemes(self):
        backgrounds = set()
        for width in (400, 1280):
            for dark in (False, True):
                for name in ("one", "two"):
                    self.open(name, width=width, dark=dark)
                    self.assertLessEqual(
                        self.browser.run("return document.scrollingElement.scrollWidth"), width)
                    backgrounds.add(self.browser.run(
                        "return getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(backgrounds), 2)

    def test_colours_differ_for_colour_blind_readers(self):
        """CIE 1976 differences after Machado et al.'s simulation (2009) of the three kinds."""
        kinds = np.array([[[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                          [[.152, 1.053, -.205], [.115, .786, .099], [-.004, -.048, 1.052]],
                          [[.367, .861, -.228], [.280, .673, .047], [-.012, .043, .969]],
                          [[1.256, -.077, -.179], [-.078, .931, .148], [.005, .691, .304]]])
        for dark in (False, True):
            self.open("two", dark=dark)
            shown = self.browser.run("""return [0, 1, 2, 3, 4, 5].map(i => getComputedStyle(
                document.body).getPropertyValue(`--c${i}`).trim())""")
            colors = np.array([[int(one[i:i + 2], 16) for i in (1, 3, 5)] for one in shown]) / 255
            linear = np.where(colors > .04045, ((colors + .055) / 1.055) ** 2.4, colors / 12.92)
            for kind in kinds:
                seen = np.clip(linear @ kind.T, 0, 1) ** (1 / 2.4) * 1.055 - .055
                lab = cv2.cvtColor(np.float32(np.clip(seen, 0, 1))[None], cv2.COLOR_RGB2LAB)[0]
                apart = np.linalg.norm(lab[:, None] - lab[None], axis=2)[np.triu_indices(6, 1)]
                self.assertGreater(apart.min(), 14)

    def test_examples_show_their_boxes(self):
        self.open("one")
        loaded = self.browser.run("""return Promise.all(
            [...document.querySelectorAll(".example image")].map(one => {
                const image = new Image();
                image.src = one.href.baseVal;
                return image.decode().then(() => [image.naturalWidth, image.naturalHeight]);
            }))""")
        self.assertEqual(loaded, [[320, 240]] * 8)
        titles = self.browser.run("""return [...document.querySelectorAll(".example rect title")]
            .map(one => one.textContent)""")
        self.assertIn("table (table)", titles)

    def test_hostile_names_are_text(self):
        self.open("hostile")
        self.assertIsNone(self.browser.run("return window.hacked || null"))
        self.assertEqual(self.browser.run("return document.querySelectorAll('script').length"), 0)
        self.assertIn(HOSTILE, self.browser.texts("table.classes tbody th"))


if __name__ == "__main__":
    unittest.main()
