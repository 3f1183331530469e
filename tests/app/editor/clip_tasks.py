"""Looking inside: local view, hiding above a height, a clipping box. The plan does not change."""
import math

from task import MUG, SOFA, TABLE, Task


class Clipping(Task):
    def objectAt(self, place):
        """The object that a click selects; 0 for none."""
        self.editor.click(place)
        selected = self.editor.state()["selected"]
        self.editor.key("esc")
        return selected[0] if selected else 0

    def pixel(self, object_id):
        return next(one["px"] for one in self.editor.state()["objects"] if one["id"] == object_id)

    def from_above(self):
        """A view from above without layers; returns the state and where the mug is."""
        state = self.start_room()
        self.without_layers()
        self.editor.point((self.editor.middle("viewport")[0], 60))
        self.editor.key("7")
        self.wait_picture()
        self.assertEqual(self.objectAt(self.pixel(MUG)), MUG)
        return state

    def expect_the_same_plan(self, before):
        state = self.editor.idle()
        self.assertEqual(state["history"], before["history"])
        self.assertEqual(state["plan"], before["plan"])

    def test_local_view(self):
        before = self.from_above()
        mug = self.pixel(MUG)
        self.select_row(SOFA)
        self.editor.point(mug)
        state = self.editor.key("/")
        self.assertTrue(state["local_view"])
        self.wait_picture()
        self.assertEqual(self.objectAt(self.pixel(SOFA)), SOFA)
        # The floor is gone.
        left, _, _, bottom = state["items"]["viewport"][:4]
        self.assertEqual(self.objectAt((left + 20, bottom - 20)), 0)
        self.assertFalse(self.editor.key("/")["local_view"])
        self.wait_picture()
        self.assertEqual(self.objectAt(mug), MUG)
        self.expect_the_same_plan(before)

    def test_the_local_view_comes_near_and_leaving_it_goes_back(self):
        self.start_room()
        self.show_preview(False)
        self.select_row(MUG)
        self.editor.point((self.editor.middle("viewport")[0], 60))
        self.wait_picture()
        before, picture = self.editor.state()["camera"], self.editor.picture()
        near = self.editor.key("/")["camera"]
        self.assertLess(math.dist(near["pivot"], (3.145, -1.245, 0.79)), 0.02)
        self.assertLess(near["distance"], 0.5 * before["distance"])
        self.assertEqual(self.editor.key("/")["camera"], before)
        self.wait_picture()
        self.assertEqual(self.editor.picture(), picture)

    def test_layers_show_only_what_belongs_to_the_local_view(self):
        self.start_room()
        self.show_preview(False)
        self.select_row(MUG)
        self.editor.point((self.editor.middle("viewport")[0], 60))
        legends = self.editor.state()["legends"]
        self.assertIn("Trajectory", legends)
        self.assertGreater(legends["Points"]["Key frame"], 1)
        self.editor.key("/")
        legends = self.editor.wait(lambda now: "Trajectory" not in now["legends"],
                                   "fewer layers")["legends"]
        self.assertEqual(legends["Points"]["Key frame"], 1)
        self.assertEqual(legends["Points"]["Observation point, small"], 1)
        self.assertEqual(legends["Points"]["Observation point, large"], 0)

    def test_hide_above_a_height(self):
        before = self.from_above()
        self.editor.run_command("hide everything above")
        self.editor.type_value("layers.hide_above.height", "0.3")
        self.assertAlmostEqual(self.editor.state()["clip"][1][2], 0.3, 9)
        self.wait_picture()
        self.assertEqual(self.objectAt(self.pixel(MUG)), TABLE, "the box below it, cut open")
        self.editor.click("layers.hide_above")
        self.wait_picture()
        self.assertEqual(self.objectAt(self.pixel(MUG)), MUG)
        self.expect_the_same_plan(before)

    def test_a_clipping_box_with_numbers_and_handles(self):
        before = self.from_above()
        self.select_row(SOFA)
        self.editor.point(self.pixel(MUG))
        low, high = self.editor.key("alt+b")["clip"]
        self.assertLess(abs(low[0] - 0.0) + abs(high[1] - -0.5), 0.02, "0.1 m around the sofa")
        self.wait_picture()
        self.assertNotEqual(self.objectAt(self.pixel(MUG)), MUG)
        x, y = self.editor.middle("clip.x.high")
        self.editor.drag((x, y), (x + 40, y))
        moved = self.editor.state()["clip"]
        self.assertGreater(moved[1][0], high[0] + 0.05, "the face follows the mouse")
        self.assertEqual([moved[0], moved[1][1:]], [low, high[1:]], "and no other")
        self.editor.click("tab.layers")
        self.editor.reach("layers.clip.x.high", "layers.clip_box")
        self.editor.type_value("layers.clip.x.high", "0.4")
        self.assertAlmostEqual(self.editor.state()["clip"][1][0], 0.4, 9)
        self.editor.point(self.pixel(MUG))
        self.assertIsNone(self.editor.key("alt+b")["clip"])
        self.wait_picture()
        self.assertEqual(self.objectAt(self.pixel(MUG)), MUG)
        self.expect_the_same_plan(before)
