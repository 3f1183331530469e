"""Damages the images and poses of a rig's cameras, see RIG."""
import numpy as np

from corruptions import found_by

# A small camera of every kind: a distorted fisheye of 190 degrees, a level panorama, an
# orthographic camera, and one beside the planned camera.
RIG = ["--camera", "wide:lens=fisheye,width_px=96,height_px=96,fov_deg=190,k1=0.02,right_m=0.05",
       "--camera", "around:lens=equirectangular,width_px=160,height_px=80,level=true",
       "--camera", "plan:lens=orthographic,width_px=96,height_px=64,px_per_m=40",
       "--camera", "left:width_px=96,height_px=72,yaw_deg=-60,pitch_deg=-5"]


def camera(copy, name):
    return next(one for one in copy.card["cameras"] if one["name"] == name)


@found_by("cameras")
def rig_focal_length_by_a_hundredth(copy):
    camera(copy, "wide")["intrinsics"]["f"] *= 1.01


@found_by("cameras")
def rig_bend_left_out(copy):
    camera(copy, "wide")["intrinsics"]["k1"] = 0.0


@found_by("cameras")
def rig_scale_of_parallel_rays(copy):
    camera(copy, "plan")["intrinsics"]["px_per_m"] = 44.0


@found_by("cameras")
def rig_principal_point_by_two_pixels(copy):
    camera(copy, "left")["intrinsics"]["cx"] -= 2.0


@found_by("cameras")
def rig_pose_by_a_centimetre(copy):
    camera(copy, "left")["poses"][2]["position"][1] += 0.01


@found_by("cameras")
def rig_mount_without_a_rotation(copy):
    camera(copy, "left")["carrier_from_camera"]["quaternion_xyzw"] = [0, 0, 0, 0]


@found_by("cameras")
def rig_panorama_that_is_not_level(copy):
    around = camera(copy, "around")
    for pose, frame in zip(around["poses"], copy.card["frames"]):
        pose["quaternion_xyzw"] = frame["quaternion_xyzw"]


@found_by("cameras")
def rig_pose_missing(copy):
    camera(copy, "plan")["poses"].pop()


@found_by("cameras")
def rig_range_said_to_be_planar(copy):
    camera(copy, "wide")["depth"]["kind"] = "planar"


@found_by("cameras")
def rig_depth_of_another_frame(copy):
    copy.swap("cameras/around/depth/000001.png", "cameras/around/depth/000004.png")


@found_by("cameras")
def rig_planar_depth_where_range_is_said(copy):
    def flatten(depth):
        lon = (np.arange(160) + 0.5) / 160 * 2 * np.pi - np.pi
        return (depth * np.abs(np.cos(lon))[None, :]).astype(np.uint16)
    copy.edit("cameras/around/depth/000002.png", flatten)


@found_by("cameras")
def rig_depth_of_one_pixel(copy):
    def deepen(depth):
        depth[40, 20] += 300
        return depth
    copy.edit("cameras/left/depth/000003.png", deepen)


@found_by("cameras")
def rig_ids_shifted_by_a_column(copy):
    for image in ("instance", "semantic"):
        copy.edit(f"cameras/plan/{image}/000001.png", lambda ids: np.roll(ids, 3, axis=1))


@found_by("cameras")
def rig_class_of_one_pixel(copy):
    def change(classes):
        classes[30, 30] = 40 if classes[30, 30] != 40 else 39
        return classes
    copy.edit("cameras/left/semantic/000000.png", change)


@found_by("cameras")
def rig_normals_from_behind(copy):
    copy.edit("cameras/left/normal_world/000001.png", lambda image: 65535 - image)


@found_by("cameras")
def rig_something_outside_of_the_circle(copy):
    def fill(image):
        image[0, 0] = (200, 200, 200)
        return image
    copy.edit("cameras/wide/rgb/000001.png", fill)


@found_by("cameras")
def rig_picture_black(copy):
    copy.edit("cameras/around/rgb/000002.png", np.zeros_like)


@found_by("cameras")
def rig_image_of_other_size(copy):
    copy.edit("cameras/wide/depth/000001.png", lambda image: image[:-1])


@found_by("cameras")
def rig_image_of_other_type(copy):
    copy.edit("cameras/wide/instance/000001.png", lambda image: image.astype(np.uint8))


@found_by("files")
def rig_image_missing(copy):
    copy.remove("cameras/wide/semantic/000004.png")
