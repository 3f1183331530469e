"""Damages files for odometry and SLAM: TUM, KITTI, TartanAir and EuRoC."""
import numpy as np

from corruptions import found_by


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
    copy.edit_lines("rgb.txt", late)


@found_by("tum")
def tum_time_of_another_depth(copy):
    def later(rows):
        rows[2][2] = rows[3][2]
    copy.edit_lines("associations.txt", later)


# --- KITTI

@found_by("poses")
def kitti_matrix_that_is_no_rotation(copy):
    def stretch(rows):
        rows[1][0] = str(float(rows[1][0]) + 0.001)
    copy.edit_lines("poses.txt", stretch)


@found_by("kitti")
def kitti_principal_point_of_half_pixels(copy):
    def shift(rows):
        rows[2][3] = str(float(rows[2][3]) + 0.5)
    copy.edit_lines("calib.txt", shift)


@found_by("kitti")
def kitti_right_camera_at_the_left(copy):
    def turn(rows):
        rows[1][4] = str(-float(rows[1][4]))
    copy.edit_lines("calib.txt", turn)


@found_by("kitti")
def kitti_times_in_milliseconds(copy):
    def scale(rows):
        for row in rows:
            row[0] = str(1000 * float(row[0]))
    copy.edit_lines("times.txt", scale)


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

def edit_array(copy, name, function):
    path = copy.folder / name
    np.save(path, function(np.load(path)))


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


# --- EuRoC

POSES = "mav0/state_groundtruth_estimate0/data.csv"


@found_by("euroc")
def euroc_quaternion_with_w_last(copy):
    def turn(rows):
        for row in rows[1:]:
            row[4:8] = row[5:8] + row[4:5]
    copy.edit_rows(POSES, turn)


@found_by("euroc")
def euroc_times_in_microseconds(copy):
    def shorten(rows):
        for row in rows[1:]:
            row[0] = str(int(row[0]) // 1000)
    copy.edit_rows(POSES, shorten)


@found_by("euroc")
def euroc_picture_of_another_frame(copy):
    names = sorted(name for name in copy.card["files"] if name.startswith("mav0/cam0/data/"))
    copy.swap(names[0], names[-1])


@found_by("euroc")
def euroc_lens_half_a_pixel_off(copy):
    cx = copy.card["conventions"]["intrinsics"]["cx"]
    copy.edit_bytes("mav0/cam0/sensor.yaml", lambda data: data.replace(
        f"{cx - 0.5:.9f}".encode(), f"{cx:.9f}".encode(), 1))


@found_by("euroc")
def euroc_right_camera_at_the_left(copy):
    baseline = copy.card["conventions"]["rgb_right"]["baseline_m"]
    copy.edit_bytes("mav0/cam1/sensor.yaml", lambda data: data.replace(
        f"{baseline:.9f}".encode(), b"0.000000000", 1))
