#!/usr/bin/python3
"""Tasks of users in the editor's real window, with a real mouse and keyboard.

Usage: tasks_test.py EDITOR COMMAND_LINE [--size 1024x700] [--theme light] [--chosen]
       [unittest arguments, such as tuning_tasks or tuning_tasks.Tuning.test_type_a_value; all tasks
       where none is named]

--size gives the screen and the window another size; --chosen runs only the tasks of CHOSEN.
"""
import argparse
import pathlib
import sys
import unittest

from task import Programs

# Forty tasks that users of 3D programs try first, for other sizes and the light theme.
CHOSEN = """
start_tasks.Starting.test_the_built_in_apartment_is_one_click_away
start_tasks.Starting.test_a_project_is_opened_with_the_keyboard
opening_tasks.Opening.test_open_a_file_by_walking_through_folders
opening_tasks.Opening.test_drop_a_scene
opening_tasks.Opening.test_a_scene_of_another_unit_is_read_as_proposed_and_back
file_tasks.Files.test_save_reopen_and_find_everything_equal
file_tasks.Files.test_quitting_with_unsaved_work_asks_and_can_be_called_off
scene_tasks.Selecting.test_click_objects_in_the_viewport
scene_tasks.Selecting.test_a_list_of_what_lies_under_the_mouse
scene_tasks.Selecting.test_search_the_list
scene_tasks.Selecting.test_exclude_an_object_and_take_it_back
scene_tasks.Selecting.test_change_an_objects_class
scene_tasks.Looking.test_orbit_pan_and_zoom
scene_tasks.Looking.test_fly_with_the_keys
scene_tasks.Looking.test_axis_views_and_parallel_projection
scene_tasks.Looking.test_look_through_the_camera_and_leave_it
scene_tasks.Timeline.test_scrub_the_timeline
scene_tasks.Timeline.test_play_and_pause
scene_tasks.Timeline.test_type_a_frame
box_select_tasks.BoxSelect.test_a_box_selects_what_is_in_it
clip_tasks.Clipping.test_local_view
clip_tasks.Clipping.test_hide_above_a_height
clip_tasks.Clipping.test_a_clipping_box_with_numbers_and_handles
transform_tasks.Transforms.test_type_a_move
transform_tasks.Transforms.test_the_mouse_moves_along_the_axis_and_a_click_confirms
transform_tasks.Transforms.test_ctrl_snaps_the_handles_and_the_keys
moving_tasks.Moving.test_move_an_object_with_the_gizmo
edit_tasks.ByHand.test_pin_a_position_point
edit_tasks.ByHand.test_put_a_no_go_box_around_an_object_and_move_it
edit_tasks.ByHand.test_split_an_object_into_its_pieces
tuning_tasks.Tuning.test_drag_a_slider_and_watch_the_plan_follow
tuning_tasks.Tuning.test_undo_and_redo_with_the_keyboard
tuning_tasks.Tuning.test_run_a_command_with_the_palette
tuning_tasks.Tuning.test_what_would_help_an_object_that_is_not_captured
motion_tasks.Motions.test_import_repair_and_plan_again
motion_tasks.Motions.test_an_orbit_of_the_selected_object
motion_tasks.CameraKeys.test_keys_are_recorded_dragged_and_removed
comparison_tasks.Comparing.test_keep_a_plan_change_it_and_swap
export_tasks.Exporting.test_find_a_modality_and_add_it_to_a_preset
window_tasks.Window.test_panels_move_to_other_sides_and_stay_there
""".split()


def read_arguments():
    """Returns the arguments of unittest."""
    parser = argparse.ArgumentParser(description=__doc__, add_help=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("editor")
    parser.add_argument("command_line")
    parser.add_argument("--size")
    parser.add_argument("--theme", choices=("dark", "light"), default="dark")
    parser.add_argument("--chosen", action="store_true")
    arguments, rest = parser.parse_known_args()
    Programs.editor = arguments.editor
    Programs.command_line = arguments.command_line
    Programs.theme = arguments.theme
    if arguments.size:
        Programs.size = Programs.screen = tuple(map(int, arguments.size.split("x")))
    named = [one for one in rest if one.endswith("_tasks") or "_tasks." in one]
    if arguments.chosen:
        return rest + CHOSEN
    if not named:
        folder = pathlib.Path(__file__).resolve().parent
        rest += sorted(path.stem for path in folder.glob("*_tasks.py"))
    return rest


if __name__ == "__main__":
    unittest.main(module=None, argv=[sys.argv[0], *read_arguments()], verbosity=2)
