"""More of corruptions.py: data besides the poses that readers of one dataset family need."""
import numpy as np

from corruptions import found_by


def edit_lines(copy, name, function):
    """Edits the words of each line of a text file."""
    path = copy.folder / name
    rows = [line.split(" ") for line in path.read_text().splitlines()]
    function(rows)
    path.write_text("".join(" ".join(row) + "\n" for row in rows))


def edit_array(copy, name, function):
    path = copy.folder / name
    np.save(path, function(np.load(path)))


# --- camera.json, transforms.json, COLMAP

@found_by("camera_json")
def vertical_field_of_view(copy):
    def lower(root):
        for entry in root:
            entry["fov"] *= entry["height"] / entry["width"]
    copy.edit_json("camera.json", lower)


@found_by("camera_json")
def far_plane_inside_the_room(copy):
    copy.edit_json("camera.json", lambda root: root[0].update(far=2.0))


@found_by("camera_json")
def targets_of_another_frame(copy):
    def move(root):
        targets = [entry["targets"] for entry in root]
        for entry, other in zip(root, targets[1:] + targets[:1]):
            entry["targets"] = other
    copy.edit_json("camera.json", move)


@found_by("transforms")
def pictures_of_the_next_frame(copy):
    def move(root):
        names = [frame["file_path"] for frame in root["frames"]]
        for frame, other in zip(root["frames"], names[1:] + names[:1]):
            frame["file_path"] = other
    copy.edit_json("transforms.json", move)


@found_by("transforms")
def principal_point_of_other_pixels(copy):
    copy.edit_json("transforms.json", lambda root: root.update(cx=root["cx"] - 0.5))


@found_by("transforms")
def room_beyond_the_unit_cube(copy):
    copy.edit_json("transforms_ngp.json", lambda root: root.update(scale=3 * root["scale"]))


@found_by("transforms")
def depth_of_the_first_frame(copy):
    def first(root):
        for frame in root["frames"]:
            frame["depth_path"] = "depth/000000.png"
    copy.edit_json("transforms_ngp.json", first)


@found_by("colmap")
def colmap_focal_lengths_of_another_size(copy):
    def halve(rows):
        rows[-1][4] = str(float(rows[-1][4]) / 2)
    edit_lines(copy, "sparse/0/cameras.txt", halve)


@found_by("colmap")
def colmap_pictures_exchanged(copy):
    def exchange(rows):
        rows[2][9], rows[4][9] = rows[4][9], rows[2][9]
    edit_lines(copy, "sparse/0/images.txt", exchange)


@found_by("colmap")
def points_before_the_surfaces(copy):
    """Moves each point halfway to the middle of the room: visible, but not on a surface."""
    def shrink(rows):
        for row in rows[1:]:
            for axis, middle in ((1, 2.0), (2, -1.5), (3, 1.3)):
                row[axis] = f"{(float(row[axis]) + middle) / 2:.9f}"
    edit_lines(copy, "sparse/0/points3D.txt", shrink)


@found_by("colmap")
def points_in_other_axes(copy):
    def exchange(rows):
        for row in rows[1:]:
            row[2], row[3] = row[3], row[2]
    edit_lines(copy, "sparse/0/points3D.txt", exchange)


# --- TUM

@found_by("tum")
def tum_depth_in_millimetres(copy):
    copy.write("depth_tum/000001.png", copy.read("depth/000001.png"))


@found_by("tum")
def tum_list_a_frame_late(copy):
    def late(rows):
        names = [row[1] for row in rows[1:]]
        for row, other in zip(rows[1:], names[1:] + names[:1]):
            row[1] = other
    edit_lines(copy, "rgb.txt", late)


@found_by("tum")
def tum_time_of_another_depth(copy):
    def later(rows):
        rows[2][2] = rows[3][2]
    edit_lines(copy, "associations.txt", later)


# --- KITTI

@found_by("kitti")
def kitti_principal_point_of_half_pixels(copy):
    def shift(rows):
        rows[2][3] = str(float(rows[2][3]) + 0.5)
    edit_lines(copy, "calib.txt", shift)


@found_by("kitti")
def kitti_right_camera_at_the_left(copy):
    def turn(rows):
        rows[1][4] = str(-float(rows[1][4]))
    edit_lines(copy, "calib.txt", turn)


@found_by("kitti")
def kitti_times_in_milliseconds(copy):
    def scale(rows):
        for row in rows:
            row[0] = str(1000 * float(row[0]))
    edit_lines(copy, "times.txt", scale)


@found_by("kitti")
def kitti_motion_upwards(copy):
    """The vertical motion with the wrong sign; OpenCV's channels are blue, green, red."""
    def mirror(image):
        image[..., 1] = np.where(image[..., 0] == 1, 65536 - image[..., 1].astype(int), 0)
        return image
    copy.edit("kitti_flow/000001.png", mirror)


@found_by("kitti")
def kitti_motion_of_nothing_known(copy):
    copy.edit("kitti_flow/000001.png", np.zeros_like)


# --- TartanAir

@found_by("tartanair")
def tartan_picture_of_another_frame(copy):
    copy.swap("image_left/000001_left.png", "image_left/000002_left.png")


@found_by("tartanair")
def tartan_depth_along_the_ray(copy):
    edit_array(copy, "depth_left/000001_left_depth.npy", lambda depth: depth * np.float32(1.01))


@found_by("tartanair")
def tartan_classes_of_ids(copy):
    ids = copy.read("instance/000001.png").astype(np.uint8)
    edit_array(copy, "seg_left/000001_left_seg.npy", lambda classes: ids)


@found_by("tartanair")
def tartan_motion_backwards(copy):
    edit_array(copy, "flow/000001_000002_flow.npy", lambda flow: -flow)


@found_by("tartanair")
def tartan_mask_of_other_values(copy):
    edit_array(copy, "flow/000001_000002_mask.npy", lambda mask: mask // 10)


@found_by("tartanair")
def tartan_depth_without_its_end(copy):
    copy.edit_bytes("depth_left/000002_left_depth.npy", lambda data: data[:-4])


@found_by("tartanair")
def tartan_right_camera_in_the_place_of_the_left(copy):
    left = (copy.folder / "pose_left.txt").read_bytes()
    (copy.folder / "pose_right.txt").write_bytes(left)


# --- both depth images are checked, whichever is wrong

def farther(copy):
    copy.edit("depth/000001.png",
              lambda depth: np.where(depth > 0, depth + 2000, 0).astype(np.uint16))


@found_by("surface")
def rounded_depth_behind_the_surfaces(copy):
    farther(copy)


@found_by("object_boxes")
def rounded_depth_outside_the_boxes(copy):
    farther(copy)
