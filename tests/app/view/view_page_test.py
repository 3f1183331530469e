#!/usr/bin/python3
"""The web page of a dataset in a real browser; without one, the tests are skipped.

Usage: view_page_test.py PROGRAM [unittest arguments]
"""
import base64
import re
import unittest

import cv2
import numpy as np

import browser
from support import tiny_room
from support.program import FolderCase, run
from view_test import card_of, changed_copy, data_of, FRAMES, HOSTILE, ViewCase


class Page(ViewCase):
    """The page in a browser. The dataset has a hostile name and an object that is not captured."""

    @classmethod
    def setUpClass(cls):
        browser.need_browser()
        super().setUpClass()
        cls.book = next(o["id"] for o in cls.card["objects"] if o["name"] == "book")
        cls.sofa = next(o["id"] for o in cls.card["objects"] if o["name"] == "sofa")

        def change(card):
            card["objects"][cls.book - 1]["name"] = HOSTILE
            for row in card["metrics"]["counted"]["per_object"]:
                if row["object_id"] == cls.book:
                    row.update(captured=False, well_captured=False)
            for row in card["metrics"]["planned"]["ledger"]:
                if row["id"] == cls.book:
                    row.update(captured=False, reason="The sofa hides it from everywhere.",
                               remedy={"text": "move the sofa <b>away</b>", "well": True})
        cls.shown = changed_copy(cls.dataset, cls.folder / "shown", change)
        cls.card = card_of(cls.shown)
        cls.page = cls.folder / "page.html"
        cls.view(cls.shown, "-o", cls.page)
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.look()
        self.browser.open(self.page)

    def tearDown(self):
        self.browser.note_logs()
        self.assertEqual(self.browser.errors, [])
        asked = [url for url in self.browser.requests
                 if not url.startswith(("file://", "data:", "about:"))]
        self.assertEqual(asked, [])

    def place(self, kind, number):
        """The position where a frame or an object can be clicked in the 3D view; None if it is
        covered."""
        at = self.browser.run(f"return datasetView.{kind}At({number})")
        under = at and self.browser.run("return datasetView.under(arguments[0], arguments[1])",
                                        round(at["x"]), round(at["y"]))
        return (at["x"], at["y"]) if under and under.get(kind) == number else None

    def open_places(self, kind, numbers):
        return {number: place for number in numbers if (place := self.place(kind, number))}

    def frame_image(self, kind, frame):
        return cv2.imread(str(self.shown / kind / f"{frame:06d}.png"), cv2.IMREAD_UNCHANGED)

    def facts(self):
        words = self.browser.texts("#objects li.chosen dt")
        return dict(zip(words, self.browser.texts("#objects li.chosen dd")))

    def hover(self, x, y):
        chain = browser.ActionChains(self.browser.driver)
        chain.w3c_actions.pointer_action.move_to_location(round(x), round(y))
        chain.perform()
        for _ in range(2):  # the pointer's place, then what it highlights
            self.browser.settle()

    def rows_in_sight(self, selector):
        """How many rows of a list its height has room for."""
        return self.browser.run("""const list = document.querySelector(arguments[0]);
            const row = list.querySelector(".row").getBoundingClientRect().height;
            return list.clientHeight / (row + 1);""", selector)

    def has_visible(self, selector):
        return self.browser.find(selector).is_displayed()

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

    # --- images, list, keys

    def test_the_list_has_room_in_every_window(self):
        for width, height in ((1280, 600), (1280, 720), (1024, 700), (2560, 1440)):
            self.browser.look(width, height)
            self.browser.open(self.page)
            with self.subTest(width=width, height=height):
                self.assertGreaterEqual(self.rows_in_sight("#objects"), 8)
                picture = self.browser.find("#picture").rect
                self.assertGreater(picture["height"], 100)
                self.assertLess(picture["y"] + picture["height"],
                                self.browser.find("#lists").rect["y"])
                self.browser.click("#to-classes")
                self.assertGreaterEqual(self.rows_in_sight("#classes"), 8)
        self.browser.look(1280, 720)
        self.browser.open(self.page)
        before = self.rows_in_sight("#objects")
        self.browser.click("#fold")
        self.assertFalse(self.has_visible("#picture"))
        self.assertGreater(self.rows_in_sight("#objects"), before + 6)
        self.browser.click("[data-modality=depth]")  # asks for an image
        self.assertTrue(self.has_visible("#picture"))
        self.assertEqual(self.rows_in_sight("#objects"), before)

    def test_an_object_that_is_not_captured_has_no_best_view(self):
        row = next(r for r in self.card["metrics"]["counted"]["per_object"]
                   if r["object_id"] == self.book)
        self.assertGreaterEqual(row["best_frame"], 0)  # a frame shows it
        self.browser.open(self.page, f"#frame={row['best_frame']}&object={self.book}")
        self.assertNotIn(HOSTILE, self.browser.text("#best-of"))
        facts = self.facts()
        self.assertEqual(facts["State"], "not captured")
        self.assertEqual(facts["Why not"], "The sofa hides it from everywhere.")
        self.assertNotIn("Best frame", facts)
        self.assertIn(f"frame {row['best_frame']}, too little", facts["Most visible in"])
        self.assertEqual(self.browser.texts("#objects li.chosen .go"), [])

    def test_each_kind_of_picture_shows_the_frame(self):
        self.browser.open(self.page, "#frame=5")
        self.assertEqual(self.browser.texts("#kinds button"),
                         ["Colour", "Depth", "Objects", "Classes"])
        self.browser.click("[data-modality=depth]")
        depth = self.frame_image("depth", 5).astype(float)
        expected = np.where(depth > 0, 255 - 215 * depth / depth.max(), 0)
        shown = self.browser.picture("#picture").mean(axis=2)
        self.assertLess(browser.difference(shown, expected), 6)
        self.browser.click("[data-modality=instance]")
        source = self.browser.find("#picture").get_attribute("src")
        colours = browser.decoded(base64.b64decode(source.split(",")[1]))
        ids = self.frame_image("instance", 5)
        self.assertEqual(colours.shape[:2], ids.shape)
        swatches = {o["id"]: o["color"][::-1] for o in data_of(self.page, "dataset")["objects"]}
        for number in set(np.unique(ids)) - {0}:
            expected = [swatches[number]]
            self.assertEqual(np.unique(colours[ids == number], axis=0).tolist(), expected)

    def test_search_and_filter_narrow_the_list(self):
        everything = self.browser.texts("#objects .name")
        targets = [o["name"] for o in self.card["objects"] if o["role"] == "target"]
        self.assertEqual(everything, targets)
        self.browser.press("/")
        self.browser.press("SOF")
        self.assertEqual(self.browser.texts("#objects .name"), ["sofa"])
        self.assertEqual(self.browser.text("#object-count"), "1 listed")
        self.browser.press("x")
        self.assertEqual(self.browser.text("#object-count"), "No object fits.")
        self.browser.press("\ue003\ue003\ue003\ue003")  # Backspace
        self.assertEqual(self.browser.texts("#objects .name"), targets)
        self.browser.find("#filter").send_keys("Not captured")
        captured = {row["object_id"] for row in self.card["metrics"]["counted"]["per_object"]
                    if row["captured"]}
        self.assertEqual(self.browser.texts("#objects .name"),
                         [o["name"] for o in self.card["objects"]
                          if o["role"] == "target" and o["id"] not in captured])
        self.browser.click(f"#objects [data-id='{self.book}'] .row")
        facts = self.facts()
        self.assertEqual(facts["State"], "not captured")
        self.assertEqual(facts["Why not"], "The sofa hides it from everywhere.")
        self.assertEqual(facts["What helps"], "move the sofa <b>away</b>")
        self.assertIsNone(self.browser.run("return window.hacked || null"))

    def test_keys_step_and_play(self):
        self.browser.press("\ue014\ue014\ue014")  # right
        self.assertIn("Frame 3 of", self.browser.text("#now"))
        self.browser.press("\ue012")  # left
        self.assertIn("Frame 2 of", self.browser.text("#now"))
        self.browser.press(" ")
        self.assertEqual(self.browser.text("#play"), "Pause")
        for _ in range(200):
            self.browser.settle()
            if self.browser.text("#play") == "Play":
                break
        self.assertIn(f"Frame {FRAMES - 1} of", self.browser.text("#now"))
        self.browser.press(" ")
        self.assertEqual(self.browser.text("#play"), "Pause")
        self.browser.press(" ")
        self.assertEqual(self.browser.text("#play"), "Play")

    def test_escape_deselects_and_space_plays_after_a_click_on_a_row(self):
        self.browser.click(f"#objects [data-id='{self.sofa}'] .row")
        self.assertEqual(self.facts()["Class"], "sofa")
        self.browser.press("\ue014")  # right
        self.assertIn("Frame 1 of", self.browser.text("#now"))
        self.browser.press(" ")
        self.assertEqual(self.browser.text("#play"), "Pause")
        self.browser.press(" ")
        self.assertEqual(self.browser.text("#play"), "Play")
        self.assertEqual(self.facts()["Class"], "sofa")
        self.browser.press("\ue00c")  # Escape
        self.assertEqual(self.facts(), {})
        self.browser.press("\ue004", " ")  # Tab leads to the next row, which the space bar presses
        self.assertEqual(self.browser.text("#play"), "Play")
        self.assertNotEqual(self.facts(), {})

    def test_a_question_mark_lists_the_keys(self):
        self.browser.click(f"#objects [data-id='{self.sofa}'] .row")
        self.assertFalse(self.has_visible("#help"))
        self.browser.press("?")
        self.assertTrue(self.has_visible("#help"))
        self.assertLessEqual({"←", "→", "Home", "End", "Space", "/", "Esc", "?"},
                             set(self.browser.texts("#help kbd")))
        self.browser.press("\ue014")  # right
        self.assertIn("Frame 0 of", self.browser.text("#now"))
        self.browser.press("\ue00c")  # Escape closes the list and keeps the selection
        self.assertFalse(self.has_visible("#help"))
        self.assertEqual(self.facts()["Class"], "sofa")
        self.browser.press("??")
        self.assertFalse(self.has_visible("#help"))
        self.browser.click("#show-help")
        self.assertTrue(self.has_visible("#help"))
        self.browser.click("#close-help")
        self.assertFalse(self.has_visible("#help"))
        self.browser.click("#show-help")
        self.browser.click_at(20, 400)  # beside the list
        self.assertFalse(self.has_visible("#help"))
        self.browser.click("#search")
        self.browser.press("?")
        self.assertFalse(self.has_visible("#help"))
        self.assertEqual(self.browser.find("#search").get_property("value"), "?")

    def test_a_link_leads_to_frame_object_and_picture(self):
        self.browser.open(self.page, f"#frame=4&object={self.sofa}&picture=depth")
        self.assertIn("Frame 4 ·", self.browser.text("#frame-facts"))
        self.assertEqual(self.facts()["Class"], "sofa")
        self.assertEqual(self.browser.find("[data-modality=depth]").get_attribute("aria-pressed"),
                         "true")
        self.browser.open(self.page, "#frame=99999&object=abc&picture=nothing&view=1")
        self.assertIn("Frame 0 ·", self.browser.text("#frame-facts"))

    def test_nothing_is_cut_or_pale(self):
        def show_classes():
            self.browser.click("#to-classes")
            self.browser.click("#classes .row")  # a hidden class
        states = [("objects", lambda: None), ("classes", show_classes),
                  ("keys", lambda: self.browser.press("?"))]
        for width, height in ((1024, 700), (1280, 720), (2560, 1440)):
            for dark in (False, True):
                self.browser.look(width, height, dark)
                self.browser.open(self.page, f"#object={self.book}")
                for state, show in states:
                    show()
                    with self.subTest(width=width, dark=dark, state=state):
                        self.assertEqual(self.browser.run(CUT_TEXTS), [])
                        self.assertEqual(self.browser.run(PALE_TEXTS), [])

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


# Elements whose text is larger than the element or the window.
CUT_TEXTS = """
const cut = [];
for (const element of document.querySelectorAll("body *")) {
  if (element.closest("script, option, #labels") || element.getClientRects().length === 0) continue;
  const own = [...element.childNodes].some(node => node.nodeType === 3 && node.data.trim() !== "");
  if (!own) continue;
  const box = element.getBoundingClientRect();
  const style = getComputedStyle(element);
  const inline = style.display === "inline";
  const list = element.closest("#objects, #classes");
  if (box.right > innerWidth + 1 || box.left < -1 || (!list && box.bottom > innerHeight + 1) ||
      (!inline && element.scrollWidth > element.clientWidth + 1))
    cut.push(`${element.tagName} ${element.id} ${element.textContent.slice(0, 40)}`);
}
return cut;
"""

# Texts with a contrast below 4.5 to 1 (WCAG 2) against their background.
PALE_TEXTS = """
const numbers = text => text.match(/[\\d.]+/g).map(Number);
const light = colour => colour.slice(0, 3).map(v => v / 255)
  .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
  .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
const behind = element => {
  for (let one = element; one; one = one.parentElement) {
    const colour = numbers(getComputedStyle(one).backgroundColor);
    if (colour.length === 3 || colour[3] > 0.5) return colour;
  }
  return [255, 255, 255];
};
const pale = [];
for (const element of document.querySelectorAll("body *")) {
  if (element.closest("script, option") || element.getClientRects().length === 0) continue;
  const own = [...element.childNodes].some(node => node.nodeType === 3 && node.data.trim() !== "");
  if (!own) continue;
  const pair = [light(numbers(getComputedStyle(element).color)), light(behind(element))];
  const contrast = (Math.max(...pair) + 0.05) / (Math.min(...pair) + 0.05);
  if (contrast < 4.5) pale.push(`${element.tagName} ${element.className} ${contrast}`);
}
return pale;
"""


if __name__ == "__main__":
    unittest.main()
