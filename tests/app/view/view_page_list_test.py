#!/usr/bin/python3
"""Images, lists, keys and layout of the web page of a dataset in a real browser; without one, the
tests are skipped.

Usage: view_page_list_test.py PROGRAM [unittest arguments]
"""
import base64
import unittest

import numpy as np

from page_case import PageCase
from support import browser
from view_case import FRAMES, HOSTILE, data_of


class PageList(PageCase):
    # --- images, list, keys

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

    # --- layout and contrast

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
