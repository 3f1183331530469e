"""The page of `view`, open in a browser."""
import cv2

from support import browser
from view_case import HOSTILE, ViewCase, card_of, changed_copy


class PageCase(ViewCase):
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
