"""Looking at the scene: selecting, hiding, the camera, layers, the timeline, the algorithm."""
import math
import os
import time

import numpy

from task import MUG, NONE, OBJECT, OBJECTS, SOFA, TABLE, Task

SOFA_TOP = (0.5, -1.5, 0.7)
TABLE_TOP = (3.3, -1.9, 0.74)


class Selecting(Task):
    def test_click_objects_in_the_viewport(self):
        self.start_room()
        self.without_layers()
        self.wait_picture()
        state = self.editor.click(self.place_of(SOFA_TOP))
        self.assertEqual((state["selection_kind"], state["selected"]), (OBJECT, [SOFA]))
        state = self.editor.click(self.place_of(TABLE_TOP), keys=["ctrl"])
        self.assertEqual((state["selection_kind"], state["selected"]), (OBJECTS, [SOFA, TABLE]))
        state = self.editor.key("esc")
        self.assertEqual((state["selection_kind"], state["selected"]), (NONE, []))

    def over_the_room(self):
        """The view from above with all layers; returns the middles of objects in the window."""
        self.start_room()
        self.show_preview(False)
        self.editor.point((self.editor.middle("viewport")[0], 60))
        self.editor.key("7")
        self.wait_picture()
        return {one["id"]: one["px"] for one in self.editor.state()["objects"]}

    def test_points_in_an_object_do_not_take_its_click(self):
        middles = self.over_the_room()
        self.editor.key("F5")  # without the trajectory, which is drawn over one of the objects
        self.wait_picture()
        # The points of mug and book are visible, and are selected by a click on their marks.
        for object_id in (TABLE, SOFA):
            state = self.editor.click(middles[object_id])
            self.assertEqual(state["selection_kind"], OBJECT, object_id)
            self.assertEqual(state["selected"], [object_id])
            self.editor.key("esc")

    def test_clicks_at_one_place_select_what_lies_behind(self):
        place = self.over_the_room()[SOFA]
        self.assertEqual(self.editor.click(place)["selected"], [SOFA])
        time.sleep(0.5)  # slower than a double click
        state = self.editor.click(place)
        self.assertNotEqual(state["selection_kind"], NONE)
        self.assertNotEqual(state["selected"], [SOFA])
        self.editor.key("esc")
        time.sleep(0.5)
        self.assertEqual(self.editor.click(place)["selected"], [SOFA], "from the front again")

    def test_a_list_of_what_lies_under_the_mouse(self):
        place = self.over_the_room()[SOFA]
        state = self.editor.click(place, keys=["alt"])
        self.assertEqual(state["selection_kind"], NONE)
        rows = sorted(name for name in state["items"] if name.startswith("pick."))
        self.assertGreaterEqual(len(rows), 3, "the sofa, a point and the floor")
        state = self.editor.click(rows[0])
        self.assertEqual(state["selected"], [SOFA])
        self.assertNotIn(rows[0], state["items"])

    def test_escape_closes_a_menu_and_nothing_else(self):
        self.start_room()
        self.select_row(SOFA)
        self.editor.click("menu.view")
        self.editor.item("command.view.preview")
        state = self.editor.key("esc")
        self.assertNotIn("command.view.preview", state["items"])
        self.assertEqual(state["selected"], [SOFA])
        self.editor.point("viewport")
        self.assertEqual(self.editor.key("esc")["selected"], [])

    def test_the_grid_is_seen_in_both_themes(self):
        self.start_room()
        self.show_preview(False)
        self.editor.click("tab.layers")
        for _ in range(2):
            self.editor.key("7")
            before = self.picture_at_rest()
            self.editor.click("layers.grid")
            after = self.picture_at_rest()
            # Beside the room, where only the background is.
            changed = sum(a != b for a, b in zip(before[2][::3], after[2][::3]))
            self.assertGreater(changed, 2000)
            self.editor.click("layers.grid")
            self.editor.menu("window", "window.light")

    def picture_at_rest(self):
        self.editor.point("viewport")
        self.wait_picture()
        time.sleep(0.5)
        self.wait_picture()
        return self.editor.picture()

    def test_select_in_the_list_and_read_about_it(self):
        self.start_room()
        state = self.select_row(SOFA)
        self.assertEqual(state["selection_kind"], OBJECT)
        self.editor.item("selection.class")
        self.editor.item("selection.target")

    def test_a_quick_click_finds_the_row_that_the_mouse_has_just_reached(self):
        self.start_room()
        state = self.select_row(SOFA)
        for row in (MUG, TABLE, SOFA, MUG):
            left, top, _, bottom = state["items"][f"objects.row.{row}"][:4]
            self.editor.click_at_once(left + 30, (top + bottom) / 2)
            state = self.editor.wait(lambda now: now["selected"] == [row], f"object {row}", 10)

    def test_shift_selects_the_rows_between(self):
        self.start_room()
        self.editor.click("tab.objects")
        rows = sorted((item[1], int(name.rsplit(".", 1)[1]))
                      for name, item in self.editor.items().items()
                      if name.startswith("objects.row."))
        ids = [row for _, row in rows]
        self.editor.click(f"objects.row.{ids[3]}")
        state = self.editor.click(f"objects.row.{ids[1]}", keys=("shift",))
        self.assertEqual(sorted(state["selected"]), sorted(ids[1:4]))

    def test_search_the_list(self):
        self.start_room()
        self.editor.click("objects.filter")
        state = self.editor.type("mug")
        rows = [name for name in state["items"] if name.startswith("objects.row.")]
        self.assertEqual(rows, [f"objects.row.{MUG}"])

    def test_go_to_the_frame_that_captures_an_object_best(self):
        self.start_room()
        self.select_row(SOFA)
        link = self.editor.reach("selection.best_frame", "selection.frame")
        self.editor.click(((link[0] + link[2]) / 2, (link[1] + link[3]) / 2))
        state = self.editor.state()
        self.assertGreater(state["frame"], 0)
        self.editor.wait(lambda now: now["preview"]["frame"] == state["frame"], "the preview")

    def test_exclude_an_object_and_take_it_back(self):
        before = self.start_room()
        self.editor.click(f"objects.target.{SOFA}")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["objects"], before["plan"]["objects"] - 1)
        self.assertEqual(state["plan"]["excluded"], 1)
        self.editor.run_command("sofa")
        self.editor.wait(lambda now: now["selected"] == [SOFA], "the sofa")
        self.editor.click("selection.target")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["objects"], before["plan"]["objects"])
        self.assertEqual(state["plan"]["frames"], before["plan"]["frames"])

    def test_change_an_objects_class(self):
        self.start_room()
        self.select_row(TABLE)
        self.editor.click("selection.class")
        self.editor.item("selection.class.filter")
        self.editor.type("bathtub")
        self.editor.click("selection.class.36")
        state = self.editor.idle()
        self.assertEqual(len(state["history"]), 2)
        self.assertIn("36", str(state["edits"]).replace("bathtub", "36"))

    def selection_pixels(self):
        """Number of pixels of the viewport in the colour of the selection, a strong pink."""
        self.editor.move(5, 5)
        self.wait_picture()
        self.editor.wait(lambda state: not state["busy"]["drawing"], "the drawing")
        left, top, right, bottom = map(round, self.editor.item("viewport")[:4])
        width, height, rgb = self.editor.picture()
        image = numpy.frombuffer(rgb, numpy.uint8).reshape(height, width, 3)[top:bottom, left:right]
        red, green, blue = image.astype(int).transpose(2, 0, 1)
        return numpy.count_nonzero((red > 200) & (green < 120) & (blue > 140))

    def test_a_hidden_object_has_no_box_and_no_handles(self):
        self.start_room()
        self.without_layers()
        self.select_row(SOFA)
        self.assertGreater(self.selection_pixels(), 200)
        self.editor.point("viewport")
        self.editor.key("h")
        self.assertEqual(self.selection_pixels(), 0)
        self.editor.point("viewport")
        self.assertEqual(self.editor.key("g")["drag_text"], "")
        self.editor.key("alt+h")
        self.assertGreater(self.selection_pixels(), 200)

    def test_hide_an_object_and_show_all(self):
        self.start_room()
        self.without_layers()
        self.editor.click(f"objects.eye.{SOFA}")
        self.wait_picture()
        state = self.editor.click(self.place_of(SOFA_TOP))
        self.assertNotIn(SOFA, state["selected"], "what is hidden cannot be clicked")
        self.editor.key("esc")
        self.editor.point("viewport")
        self.editor.key("alt+h")
        self.wait_picture()
        state = self.editor.click(self.place_of(SOFA_TOP))
        self.assertEqual(state["selected"], [SOFA])


class Looking(Task):
    def test_orbit_pan_and_zoom(self):
        start = self.start_room()["camera"]
        x, y = self.editor.middle("viewport")
        y -= 60
        turned = self.editor.drag((x, y), (x + 120, y + 40))["camera"]
        self.assertNotAlmostEqual(turned["azimuth"], start["azimuth"], 1)
        self.assertEqual(turned["pivot"], start["pivot"])
        back = self.editor.drag((x, y), (x - 120, y - 40), button="middle")["camera"]
        self.assertNotAlmostEqual(back["azimuth"], turned["azimuth"], 1)
        self.assertEqual(back["pivot"], start["pivot"], "the middle button orbits, too")
        for button in ("left", "middle"):
            moved = self.editor.drag((x, y), (x + 80, y), button=button, keys=["shift"])["camera"]
            self.assertEqual(moved["azimuth"], back["azimuth"])
            self.assertGreater(math.dist(moved["pivot"], back["pivot"]), 0.1)
            back = moved
        self.editor.wheel((x, y), 4)
        near = self.editor.state()["camera"]
        self.assertLess(near["distance"], 0.75 * moved["distance"])
        looked = self.editor.drag((x, y), (x + 60, y), button="right")["camera"]
        self.assertNotEqual(looked["azimuth"], near["azimuth"])

    def test_zoom_keeps_the_point_under_the_mouse(self):
        self.start_room()
        self.wait_picture()
        place = self.place_of(SOFA_TOP)
        self.editor.wheel(place, 5)
        after = self.place_of(SOFA_TOP)
        self.assertLess(math.dist(place, after), 8, "px")

    def test_zoom_and_pan_over_a_handle(self):
        self.start_room()
        self.select_row(SOFA)  # the preview covers others
        self.editor.item("gizmo.free")
        self.wait_picture()
        place = self.editor.middle("gizmo.free")
        before = self.editor.state()["camera"]
        self.editor.wheel(place, 2)
        after = self.editor.idle()
        self.assertLess(after["camera"]["distance"], before["distance"])
        self.editor.drag(self.editor.middle("gizmo.free"), (place[0] + 80, place[1]), "middle",
                         keys=["shift"])
        panned = self.editor.idle()
        self.assertNotEqual(panned["camera"]["pivot"], after["camera"]["pivot"])
        self.assertEqual(len(panned["history"]), 1, "nothing was moved")

    def test_fly_with_the_keys(self):
        start = self.start_room()["camera"]
        x, y = self.editor.middle("viewport")
        self.editor.point((x, y - 60))
        self.editor.press("right")
        self.editor.state()
        self.editor.hold("w")
        for _ in range(10):
            self.editor.state()
        self.editor.let_go("w")
        self.editor.release("right")
        self.assertGreater(math.dist(self.editor.state()["camera"]["pivot"], start["pivot"]), 0.05)

    def test_a_held_key_stops_with_its_release(self):
        self.start_room()
        x, y = self.editor.middle("viewport")
        self.editor.point((x, y - 60))
        self.editor.press("right")
        start = self.editor.state()["camera"]
        with self.editor.stuck():
            self.editor.hold("w")
            time.sleep(2)  # the keyboard repeats the key about 40 times
            self.editor.let_go("w")
        flown = self.editor.state()["camera"]
        self.editor.release("right")
        # At most 0.2 m in each of the few frames between press and release.
        self.assertGreater(math.dist(flown["pivot"], start["pivot"]), 0)
        self.assertLess(math.dist(flown["pivot"], start["pivot"]), 1.0)

    def test_axis_views_and_parallel_projection(self):
        self.start_room()
        state = self.editor.key("7")
        self.assertAlmostEqual(state["camera"]["elevation"], math.pi / 2)
        state = self.editor.key("1")
        self.assertAlmostEqual(state["camera"]["elevation"], 0.0)
        front = state["camera"]["azimuth"]
        state = self.editor.key("ctrl+1")
        self.assertAlmostEqual(abs(state["camera"]["azimuth"] - front), math.pi)
        state = self.editor.key("5")
        self.assertTrue(state["camera"]["orthographic"])
        self.assertFalse(self.editor.key("5")["camera"]["orthographic"])

    def test_the_number_pad_looks_along_the_axes(self):
        self.start_room()
        for key, name in (("KP_7", "Top"), ("KP_1", "Front"), ("KP_3", "Right"),
                          ("ctrl+KP_1", "Back"), ("ctrl+KP_3", "Left"), ("ctrl+KP_7", "Bottom")):
            self.assertEqual(self.editor.key(key)["view_name"], name + " Perspective")
        self.assertEqual(self.editor.key("KP_5")["view_name"], "Bottom Orthographic")
        state = self.editor.key("KP_5")
        self.assertEqual(state["view_name"], "Bottom Perspective")
        self.assertIn("viewport.name", state["items"])
        left, top, right, bottom = self.editor.item("viewport")[:4]
        middle = ((left + right) / 2, (top + bottom) / 2)
        state = self.editor.drag(middle, (middle[0] + 30, middle[1] - 20), button="middle")
        self.assertEqual(state["view_name"], "User Perspective")
        self.select_row(MUG)
        self.assertTrue(self.editor.key("num/")["local_view"])
        self.assertFalse(self.editor.key("num/")["local_view"])

    def test_the_number_pad_orbits(self):
        self.start_room()
        before = self.editor.key("KP_1")["camera"]
        for key, name, value in (("KP_6", "azimuth", 15), ("KP_8", "elevation", 15),
                                 ("KP_4", "azimuth", 0), ("KP_2", "elevation", 0)):
            turned = self.editor.key(key)["camera"][name] - before[name]
            self.assertAlmostEqual(math.degrees(turned), value, 6, key)
        self.assertEqual(self.editor.key("KP_9")["view_name"], "Back Perspective")
        self.assertTrue(self.editor.key("KP_0")["through_camera"])
        state = self.editor.key("KP_8")
        self.assertFalse(state["through_camera"])
        self.assertAlmostEqual(math.degrees(state["camera"]["elevation"]), 15, 6)

    def test_keys_leave_the_camera_for_the_view_before_and_drags_continue_from_it(self):
        self.start_room()
        self.editor.point("viewport")
        self.editor.wheel("viewport", 4)
        self.editor.key("KP_5")
        before = self.editor.state()["camera"]
        self.assertTrue(before["orthographic"])
        self.assertTrue(self.editor.key("KP_0")["through_camera"])
        state = self.editor.key("KP_0")
        self.assertEqual((state["through_camera"], state["camera"]), (False, before))
        self.editor.key("KP_0")
        camera = self.editor.key("KP_7")["camera"]
        self.assertEqual(camera["elevation"], math.pi / 2)
        for name in ("pivot", "distance", "orthographic"):
            self.assertEqual(camera[name], before[name])
        self.editor.key("KP_0")
        left, top, right, bottom = self.editor.item("viewport")[:4]
        middle = ((left + right) / 2, (top + bottom) / 2)
        state = self.editor.drag(middle, (middle[0] + 30, middle[1]), button="middle")
        # Dragging continues from the camera, around what it looks at.
        self.assertFalse(state["through_camera"])
        self.assertFalse(state["camera"]["orthographic"])
        self.assertLessEqual(state["camera"]["distance"], 4.0)
        self.assertNotEqual(state["camera"]["pivot"], before["pivot"])

    def test_frame_the_selected_object(self):
        self.start_room()
        self.select_row(MUG)
        self.editor.point("viewport")
        for key in ("f", "num."):
            self.assertGreater(self.editor.key("home")["camera"]["distance"], 3.0)
            camera = self.editor.key(key)["camera"]
            self.assertLess(math.dist(camera["pivot"], (3.145, -1.245, 0.79)), 0.02)
            self.assertLess(camera["distance"], 1.0)
        for view in ("1", "3", "ctrl+1", "ctrl+3"):  # whatever hides it
            before = self.editor.key(view)["camera"]
            camera = self.editor.key("f")["camera"]
            for angle in ("azimuth", "elevation"):
                self.assertEqual(camera[angle], before[angle], view)

    def test_look_through_the_camera_and_leave_it(self):
        self.start_room()
        self.assertTrue(self.editor.key("0")["through_camera"])
        self.assertFalse(self.editor.key("esc")["through_camera"])

    def test_switch_layers(self):
        self.start_room()
        for key, layer in (("F2", "free_space"), ("F3", "points"), ("F4", "roadmap"),
                           ("F5", "trajectory"), ("F7", "no_go")):
            before = self.editor.state()["layers"][layer]
            picture = self.editor.picture()
            state = self.editor.key(key)
            self.assertNotEqual(state["layers"][layer], before, layer)
            if layer != "no_go":  # there is none to be seen
                self.wait_picture()
                self.assertNotEqual(self.editor.picture(), picture, layer)

    def test_a_click_right_after_the_wheel_hits_what_was_scrolled_there(self):
        self.start_room(size=(1280, 620))
        self.editor.click("tab.layers")
        before = self.editor.item("layers.roadmap")
        over = self.editor.middle("layers.trajectory")
        self.editor.wheel(over, -1)
        after = self.editor.item("layers.roadmap")
        self.assertLess(after[1], before[1], "the panel has scrolled")
        self.editor.wheel(over, 5)
        self.assertEqual(self.editor.item("layers.roadmap"), before)
        state = self.editor.state()
        with self.editor.stuck():
            self.editor.press(5)
            self.editor.release(5)
            self.editor.move(after[0] + 8, (after[1] + after[3]) / 2)
            self.editor.press()
            self.editor.release()
        clicked = self.editor.state()
        self.assertNotEqual(clicked["layers"]["roadmap"], state["layers"]["roadmap"])
        # In the viewport, the wheel would have zoomed.
        left, top, right, bottom = self.editor.item("viewport")[:4]
        with self.editor.stuck():
            self.editor.move(*over)
            self.editor.press(4)
            self.editor.release(4)
            self.editor.move((left + right) / 2, (top + bottom) / 2)
        self.assertEqual(self.editor.state()["camera"], state["camera"])

    def test_move_the_slice_of_free_space(self):
        self.start_room()
        self.editor.key("F2")
        before = self.editor.state()["layers"]["slice_m"]
        self.wait_picture()
        picture = self.editor.picture()
        up = self.editor.key("pageup")["layers"]["slice_m"]
        self.assertAlmostEqual(up - before, 0.05, 6)
        self.assertAlmostEqual(self.editor.key("pagedown")["layers"]["slice_m"], before, 6)
        self.editor.run_command("slice height")
        self.editor.type_value("layers.slice.position", "0.35")
        state = self.editor.wait(lambda now: abs(now["layers"]["slice_m"] - 0.35) < 1e-6,
                                 "the slice")
        self.wait_picture()
        self.assertNotEqual(self.editor.picture(), picture)
        self.assertTrue(state["layers"]["free_space"])

    def test_the_window_rests_when_nothing_happens(self):
        self.start_room()
        self.editor.wait(lambda state: state["preview"]["final_light"] and
                         not state["busy"]["drawing"], "the light", 60)
        self.editor.state()
        used = self.processor_seconds()
        serial = self.editor.state()["picture_serial"]
        time.sleep(2.0)
        self.assertLess(self.processor_seconds() - used, 0.6, "s of work in 2 s of rest")
        self.assertEqual(self.editor.state()["picture_serial"], serial)

    def processor_seconds(self):
        with open(f"/proc/{self.editor.process.pid}/stat") as file:
            fields = file.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Timeline(Task):
    def test_scrub_the_timeline(self):
        state = self.start_room()
        left, top, right, bottom = self.editor.item("timeline.axis")[:4]
        y = top + 8
        seen = []
        self.editor.drag((left + 0.4 * (right - left), y), (left + 0.9 * (right - left), y),
                         look=lambda now: seen.append(now["frame"]))
        self.assertEqual(seen, sorted(seen))
        self.assertGreater(seen[-1] - seen[0], state["plan"]["frames"] // 5)
        self.editor.wait(lambda now: now["preview"]["frame"] == now["frame"], "the preview")

    def test_play_and_pause(self):
        self.start_room()
        self.assertTrue(self.editor.key("space")["playing"])
        self.editor.wait(lambda state: state["frame"] >= 5, "the fifth frame", 20)
        state = self.editor.key("space")
        self.assertFalse(state["playing"])
        self.assertEqual(self.editor.state()["frame"], state["frame"])

    def test_step_through_frames_and_key_frames(self):
        state = self.start_room()
        keys = sorted(int(name.rsplit(".", 1)[1]) for name in state["items"]
                      if name.startswith("timeline.key."))
        self.assertEqual(len(keys), state["plan"]["key_frames"])
        self.assertEqual(self.editor.key("right")["frame"], 1)
        self.assertEqual(self.editor.key("left")["frame"], 0)
        self.assertEqual(self.editor.key("shift+right")["frame"], keys[1])
        self.assertEqual(self.editor.click("timeline.next_key")["frame"], keys[2])
        self.assertEqual(self.editor.click("timeline.previous_key")["frame"], keys[1])
        self.assertEqual(self.editor.click("timeline.end")["frame"], state["plan"]["frames"] - 1)
        self.assertEqual(self.editor.click("timeline.start")["frame"], 0)

    def test_every_press_counts_although_the_window_is_busy(self):
        self.start_room()
        self.editor.point("viewport")
        with self.editor.stuck():
            for _ in range(20):
                self.editor.hold("right")
                self.editor.let_go("right")
                time.sleep(0.004)  # GLFW ignores a second press within the same millisecond
        # Every frame of the window takes one of the events, which arrived all at once.
        points = self.editor.wait(lambda state: state["frame"] == 20, "20 steps",
                                  20)["layers"]["points"]
        with self.editor.stuck():
            for name in ("left", "F3"):  # both are held down at a time
                self.editor.hold(name)
            for name in ("left", "F3"):
                self.editor.let_go(name)
        self.editor.wait(lambda state: state["frame"] == 19 and
                         state["layers"]["points"] != points, "both commands", 20)

    def test_type_a_frame(self):
        self.start_room()
        self.assertEqual(self.editor.type_value("timeline.frame", "42")["frame"], 42)

    def test_step_the_algorithm_forward_and_back(self):
        state = self.start_room()
        steps = state["plan"]["steps"]
        self.editor.click("tab.algorithm")
        self.assertTrue(self.editor.state()["layers"]["stepping"])
        self.assertEqual(self.editor.click("steps.forward")["step"], 1)
        self.assertEqual(self.editor.click("steps.forward")["step"], 2)
        self.assertEqual(self.editor.click("steps.back")["step"], 1)
        self.assertEqual(self.editor.click("steps.last")["step"], steps)
        self.assertEqual(self.editor.click("steps.first")["step"], 0)
        self.editor.click("steps.play")
        self.editor.wait(lambda now: now["step"] >= 3, "steps to be played", 20)
