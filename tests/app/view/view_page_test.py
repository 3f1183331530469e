#!/usr/bin/python3
"""The 3D view in the web page of a dataset, in a real browser; without one, the tests are skipped.

Usage: view_page_test.py PROGRAM [unittest arguments]
"""
import re
import unittest

import numpy as np

from page_case import PageCase
from support import browser, tiny_room
from support.program import FolderCase, run
from view_case import FRAMES, changed_copy, data_of


class Page(PageCase):
    # --- the 3D view

    def test_the_view_shows_something_that_turns(self):
        before = self.browser.picture("canvas")
        self.assertGreater(len(np.unique(before.reshape(-1, 3), axis=0)), 100)
        self.browser.drag(400, 600, 160, 20)
        turned = self.browser.picture("canvas")
        self.assertGreater(browser.difference(before, turned), 4)
        self.browser.click("#reset")
        self.assertLess(browser.difference(before, self.browser.picture("canvas")), 0.5)
        self.browser.click("#show-room")
        self.assertGreater(browser.difference(before, self.browser.picture("canvas")), 4)

    def test_a_click_on_a_camera_shows_its_frame(self):
        places = self.open_places("frame", range(FRAMES))
        self.assertGreater(len(places), 3)
        for frame, place in list(places.items())[1:4]:
            self.browser.click_at(*place)
            self.assertIn(f"Frame {frame} ·", self.browser.text("#frame-facts"))
            self.assertIn(f"Frame {frame} of", self.browser.text("#now"))
            shown = self.browser.picture("#picture")
            apart = [browser.difference(shown, self.frame_image("rgb", i)) for i in range(FRAMES)]
            self.assertEqual(int(np.argmin(apart)), frame)
            self.assertLess(apart[frame], 6)

    def test_a_click_on_a_name_selects_its_object(self):
        tags = self.browser.run("""return [...document.querySelectorAll("#labels span")]
            .filter(span => !span.hidden && !span.className).map(span => {
              const box = span.getBoundingClientRect();
              return [span.textContent, box.left + box.width / 2, box.top + box.height / 2];
            });""")
        self.assertGreater(len(tags), 1)
        for name, x, y in tags[:2]:
            self.browser.click_at(x, y)
            chosen = self.browser.run("return objectById.get(state.object).name")
            self.assertEqual(chosen, name)
            self.browser.click_at(40, 700)  # beside everything

    def test_a_click_on_an_object_shows_its_row(self):
        self.browser.click("#show-cameras")
        places = self.open_places("object", [self.sofa])
        self.assertIn(self.sofa, places)
        self.browser.click_at(*places[self.sofa])
        row = next(r for r in self.card["metrics"]["counted"]["per_object"]
                   if r["object_id"] == self.sofa)
        facts = self.facts()
        self.assertEqual(facts["Class"], "sofa")
        self.assertEqual(facts["State"], "well captured" if row["well_captured"] else
                         "captured" if row["captured"] else "not captured")
        self.assertEqual(int(facts["Best frame"]), row["best_frame"])
        for word, key in (("Visible share", "visible_fraction"), ("In the picture", "box_share")):
            share = float(re.search(r"[\d.]+", facts[word])[0]) / 100
            self.assertAlmostEqual(share, row[key], delta=6e-4)
        self.browser.click("#objects li.chosen .go")
        self.assertIn(f"Frame {row['best_frame']} ·", self.browser.text("#frame-facts"))
        self.assertIn("sofa", self.browser.text("#best-of"))
        self.browser.click_at(40, 700)  # beside everything
        self.assertEqual(self.facts(), {})

    def test_moving_objects_stand_where_the_frame_has_them(self):
        mug = next(o["id"] for o in self.card["objects"] if o["name"] == "mug")
        seen = []
        for key in ("\ue011", "\ue010"):  # Home, End
            self.browser.press(key)
            seen.append(self.browser.run(f"return datasetView.objectAt({mug})"))
        moved = np.hypot(seen[0]["x"] - seen[1]["x"], seen[0]["y"] - seen[1]["y"])
        self.assertGreater(moved, 10)

    def test_a_hint_is_shown_until_the_first_click(self):
        self.assertIn("Click a camera", self.browser.text("#hint"))
        height = self.browser.run("return document.getElementById('hint').clientHeight")
        self.assertLess(height, 32)  # one line
        self.browser.drag(400, 600, 60, 10)
        self.assertTrue(self.has_visible("#hint"))
        self.browser.click_at(40, 700)  # beside everything
        self.assertFalse(self.has_visible("#hint"))

    def test_cameras_and_boxes_under_the_pointer_stand_out(self):
        cursor = "return getComputedStyle(document.querySelector('canvas')).cursor"
        self.browser.run("document.getElementById('hover').style.opacity = 0")  # covers the view
        cameras = self.open_places("frame", range(1, FRAMES))
        self.assertGreater(len(cameras), 2)
        self.browser.click("#show-labels")
        self.hover(40, 700)
        self.assertEqual(self.browser.run(cursor), "grab")
        before = self.browser.picture("canvas")
        self.hover(42, 702)
        self.assertLess(browser.difference(before, self.browser.picture("canvas")), 1e-3)

        def changed_pixels():
            apart = np.abs(before.astype(int) - self.browser.picture("canvas")).max(axis=2)
            return int((apart > 40).sum())
        for frame, place in list(cameras.items())[:2]:
            self.hover(*place)
            self.assertEqual(self.browser.run(cursor), "pointer")
            self.assertIn(f"Frame {frame}:", self.browser.run(
                "return document.getElementById('hover').textContent"))
            self.assertGreater(changed_pixels(), 20)
            self.assertNotIn(f"Frame {frame} of", self.browser.text("#now"))
        sofa = self.browser.run(f"return datasetView.objectAt({self.sofa})")
        self.hover(sofa["x"], sofa["y"])
        self.assertEqual(self.browser.run(cursor), "pointer")
        self.assertGreater(changed_pixels(), 100)
        self.hover(40, 700)
        self.assertEqual(self.browser.run(cursor), "grab")
        self.assertEqual(changed_pixels(), 0)

    # --- classes

    def test_the_class_legend_counts_the_objects(self):
        self.assertFalse(self.has_visible("#classes"))
        self.browser.click("#to-classes")
        self.assertFalse(self.has_visible("#objects"))
        names = {one["id"]: one["name"] for one in self.card["classes"]}
        captured = {row["object_id"] for row in self.card["metrics"]["counted"]["per_object"]
                    if row["captured"]}
        expected = {}
        for one in self.card["objects"]:
            if one["role"] != "target":
                continue
            counts = expected.setdefault(names[one["nyu40"]], [0, 0])
            counts[0] += one["id"] in captured
            counts[1] += 1
        shown = dict(zip(self.browser.texts("#classes .name"),
                         self.browser.texts("#classes .state")))
        self.assertEqual(shown, {name: f"{some} of {all_} captured"
                                 for name, (some, all_) in expected.items()})
        self.browser.click("[data-list=object-list]")
        self.assertTrue(self.has_visible("#objects"))

    def test_a_click_on_a_class_hides_its_boxes(self):
        self.browser.click("[data-list=class-legend]")
        for layer in ("room", "path", "cameras"):
            self.browser.click(f"#show-{layer}")
        label = "return [...document.querySelectorAll('#labels span:not([hidden])')]" \
                ".some(one => one.textContent === 'sofa')"
        at = self.browser.run(f"return datasetView.objectAt({self.sofa})")
        under = lambda: self.browser.run("return datasetView.under(arguments[0], arguments[1])",
                                         at["x"], at["y"])
        row = "#classes [data-class=sofa]"
        swatch = self.browser.run("return getComputedStyle(document.querySelector("
                                  f"'{row} .color')).backgroundColor")
        ground = self.browser.picture("canvas")[400, 5].astype(float)
        color = np.array([float(part) for part in re.findall(r"[\d.]+", swatch)][:3][::-1])
        line = 0.75 * color + 0.25 * ground

        def pixels_of_lines():
            return int((np.abs(self.browser.picture("canvas") - line).max(axis=2) < 10).sum())
        shown = pixels_of_lines()
        self.assertGreater(shown, 100)
        self.assertTrue(self.browser.run(label))
        self.assertEqual(under(), {"object": self.sofa})
        self.browser.click(row)
        self.assertEqual(self.browser.find(row).get_attribute("aria-pressed"), "false")
        self.assertLess(pixels_of_lines(), 0.1 * shown)
        self.assertFalse(self.browser.run(label))
        self.assertNotEqual(under(), {"object": self.sofa})
        self.browser.click(row)
        self.assertEqual(pixels_of_lines(), shown)
        self.assertTrue(self.browser.run(label))
        self.browser.click("#hide-classes")
        self.assertEqual(self.browser.run("return [...document.querySelectorAll("
                                          "'#labels span:not([hidden]):not(.camera)')].length"), 0)
        self.browser.click("#show-classes")
        self.assertEqual(pixels_of_lines(), shown)

    def test_boxes_can_be_coloured_by_capture(self):
        by_class = self.browser.picture("canvas")
        self.assertFalse(self.has_visible(".by-capture"))
        self.browser.find("#colors").send_keys("by capture")
        self.browser.settle()
        self.assertEqual(self.browser.texts(".by-capture"),
                         ["well captured", "captured", "not captured"])
        self.assertFalse(self.has_visible("#to-classes"))
        by_capture = self.browser.picture("canvas")
        self.assertGreater(browser.difference(by_class, by_capture), 0.02)
        self.browser.open(self.page, "#colors=capture")
        self.assertEqual(self.browser.find("#colors").get_property("value"), "capture")
        swatch = "return getComputedStyle(document.querySelector(" \
                 f"'#objects [data-id=\"{self.book}\"] .color')).backgroundColor"
        self.assertEqual(self.browser.run(swatch), "rgb(198, 42, 32)")

    # --- datasets with fewer files

    def test_without_the_scene_boxes_and_trajectory_are_left(self):
        alone = self.folder / "alone" / "dataset"
        alone.parent.mkdir()

        def change(card):
            card["scene"]["path"] = "/nowhere/room.obj"
            card["scene"]["file"] = "gone.obj"
        changed_copy(self.dataset, alone, change)
        made = self.view(alone)
        self.assertIn("gone.obj", made.stderr)
        self.browser.open(self.folder / "alone" / "dataset.html")
        self.assertIn("gone.obj", self.browser.text("#notes"))
        picture = self.browser.picture("canvas")
        self.assertGreater(len(np.unique(picture.reshape(-1, 3), axis=0)), 30)
        self.assertEqual(self.browser.driver.find_elements("id", "show-room"), [])
        self.browser.click("#show-cameras")
        at = self.browser.run(f"return datasetView.objectAt({self.sofa})")
        self.browser.click_at(at["x"], at["y"])
        self.assertEqual(self.facts()["Class"], "sofa")

    def test_without_webgl_frames_and_lists_are_left(self):
        plain = browser.Browser("--disable-3d-apis")
        self.addCleanup(plain.close)
        plain.look()
        plain.open(self.page)
        self.assertIn("no WebGL", plain.text("#no-webgl"))
        plain.press("\ue014")
        self.assertIn("Frame 1 of", plain.text("#now"))
        shown = plain.picture("#picture")
        self.assertLess(browser.difference(shown, self.frame_image("rgb", 1)), 6)
        self.assertIn("sofa", plain.texts("#objects .name"))


class Storeys(FolderCase):
    def test_a_storey_can_be_chosen(self):
        browser.need_browser()
        boxes = []
        for level in (0, 1):
            y = 3.0 * level
            boxes += [(f"floor_{level}", (0, y - 0.3, 0), (4, y, 3)),
                      (f"wall_{level}_1", (-0.1, y, 0), (0, y + 2.7, 3)),
                      (f"wall_{level}_2", (4, y, 0), (4.1, y + 2.7, 3)),
                      (f"wall_{level}_3", (0, y, -0.1), (4, y + 2.7, 0)),
                      (f"wall_{level}_4", (0, y, 3), (4, y + 2.7, 3.1)),
                      (f"table_{level}", (2.6, y, 0.8), (3.4, y + 0.74, 2.2))]
        boxes.append(("ceiling", (0, 5.7, 0), (4, 5.8, 3)))
        scene = self.folder / "storeys.obj"
        tiny_room.write_boxes(scene, boxes)
        made = run("export", scene, "--out", self.folder / "storeys", "--max-frames", "8",
                   "--set", "width_px=64", "--set", "height_px=48")
        self.assertIn(made.returncode, (0, 3), made.stderr)
        page = self.folder / "storeys.html"
        self.assertEqual(run("view", self.folder / "storeys", "-o", page).returncode, 0)
        self.assertEqual(len(data_of(page, "room")["storeys"]), 2)
        shown = browser.Browser()
        self.addCleanup(shown.close)
        shown.look()
        shown.open(page)
        both = shown.picture("canvas")
        self.assertEqual(shown.texts("#storey option"), ["up to 1", "all"])
        names = "return [...document.querySelectorAll('#labels span:not([hidden])')]" \
                ".filter(label => label.className !== 'camera').map(label => label.textContent)"
        self.assertIn("table_1", shown.run(names))
        places = "return frames.map(frame => { const at = datasetView.frameAt(frame.index);" \
                 "return at && datasetView.under(Math.round(at.x), Math.round(at.y)); })"
        self.assertEqual(shown.run(places), [{"frame": 0}, {"frame": 1}])
        shown.find("#storey").send_keys("up")
        shown.settle()
        below = [bool(place) and "frame" in place for place in shown.run(places)]
        self.assertEqual(sorted(below), [False, True])
        self.assertEqual(shown.run(names), ["table_0"])
        self.assertGreater(browser.difference(both, shown.picture("canvas")), 4)


if __name__ == "__main__":
    unittest.main()
