"""Damages images that have geometry: depth, normals, object coordinates, flow, stereo."""
import numpy as np

from corruptions import found_by


# --- depth

@found_by("holes")
def hole_in_the_depth(copy):
    def hole(depth):
        depth[10, 10] = 0
        return depth
    copy.edit("depth/000002.png", hole)


@found_by("holes")
def exact_depth_of_nothing(copy):
    copy.edit("depth_exr/000001.exr", lambda image: 0 * image)


@found_by("object_boxes")
def depth_scaled(copy):
    copy.edit("depth/000001.png", lambda depth: (depth * 1.05).astype(np.uint16))
    copy.edit("depth_exr/000001.exr", lambda depth: (depth * 1.05).astype(np.float32))


@found_by("surface")
def depth_along_the_ray(copy):
    lens = copy.card["conventions"]["intrinsics"]
    x, y = np.meshgrid(np.arange(lens["width"]) + 0.5, np.arange(lens["height"]) + 0.5)
    longer = np.sqrt(1 + ((x - lens["cx"]) / lens["fx"]) ** 2 + ((y - lens["cy"]) / lens["fy"]) ** 2)
    copy.edit("depth/000001.png", lambda depth: np.rint(depth * longer).astype(np.uint16))
    copy.edit("depth_exr/000001.exr", lambda depth: (depth * longer).astype(np.float32))


@found_by("depth_exr")
def one_pixel_of_depth(copy):
    def nearer(depth):
        depth[30, 40] -= 2
        return depth
    copy.edit("depth/000002.png", nearer)


# Both depth images are checked, whichever is wrong.
def farther(copy):
    copy.edit("depth/000001.png",
              lambda depth: np.where(depth > 0, depth + 2000, 0).astype(np.uint16))


@found_by("surface")
def rounded_depth_behind_the_surfaces(copy):
    farther(copy)


@found_by("object_boxes")
def rounded_depth_outside_the_boxes(copy):
    farther(copy)


# --- all images of a frame

@found_by("surface")
def swapped_frames(copy):
    for folder, ending in [("rgb", "png"), ("depth", "png"), ("depth_exr", "exr"),
                           ("instance", "png"), ("semantic", "png")]:
        copy.swap(f"{folder}/000000.{ending}", f"{folder}/000003.{ending}")


@found_by("surface")
def mirrored_image(copy):
    for name in ["rgb/000001.png", "depth/000001.png", "depth_exr/000001.exr",
                 "instance/000001.png", "semantic/000001.png"]:
        copy.edit(name, lambda image: np.ascontiguousarray(image[:, ::-1]))


@found_by("surface")
def thing_erased(copy):
    """Replaces an object of tiny_room by the wall behind it, in every image."""
    frame = copy.card["frames"][1]
    lens = copy.card["conventions"]["intrinsics"]
    ids = {entry["name"]: entry for entry in copy.card["objects"]}
    image = copy.read("instance/000001.png")
    targets = [entry["id"] for entry in copy.card["objects"] if entry["role"] == "target"]
    erased = max(targets, key=lambda one: (image == one).sum())
    rows, columns = np.nonzero(image == erased)
    assert len(rows) > 200
    source_from_world = np.array(copy.card["scene"]["source_from_world"])
    x, y, z, w = frame["quaternion_xyzw"]
    axes = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    along = np.stack([(columns + 0.5 - lens["cx"]) / lens["fx"],
                      (rows + 0.5 - lens["cy"]) / lens["fy"], np.ones(len(rows))])
    along = source_from_world[:3, :3] @ axes @ along
    start = (source_from_world @ [*frame["position"], 1])[:3, None]
    planes = [("wall_1", 0, 0), ("wall_2", 0, 4), ("floor", 1, 0), ("ceiling", 1, 2.6),
              ("wall_3", 2, 0), ("wall_4", 2, 3)]
    with np.errstate(divide="ignore"):
        depths = np.array([(place - start[axis]) / along[axis] for _, axis, place in planes])
    depths[depths <= 0] = np.inf
    nearest = depths.argmin(axis=0)
    metres = depths.min(axis=0)
    wall = [ids[name] for name, _, _ in planes]
    for name, values in (("instance", [wall[i]["id"] for i in nearest]),
                         ("semantic", [wall[i]["nyu40"] for i in nearest]),
                         ("depth", np.round(1000 * metres))):
        changed = copy.read(f"{name}/000001.png")
        changed[rows, columns] = values
        copy.write(f"{name}/000001.png", changed)
    exact = copy.read("depth_exr/000001.exr")
    exact[rows, columns] = metres
    copy.write("depth_exr/000001.exr", exact)


# --- normals and object coordinates

@found_by("normals")
def channels_of_normals_swapped(copy):
    copy.edit("normal_world/000001.png", lambda image: image[:, :, ::-1])


@found_by("normals")
def normals_reversed(copy):
    for folder in ("normal_camera", "normal_world"):
        def reverse(image):
            return np.where(image.any(axis=2, keepdims=True), 65535 - image, 0).astype(np.uint16)
        copy.edit(f"{folder}/000001.png", reverse)


@found_by("object_coordinates")
def coordinates_shifted(copy):
    copy.edit("object_coordinates/000001.png",
              lambda image: np.where(image > 0, image // 2, 0).astype(np.uint16))


# --- flow

@found_by("flow")
def flow_reversed(copy):
    copy.edit_flow("flow_forward/000000_000001.flo", lambda uv: np.where(uv < 1e9, -uv, uv))


@found_by("flow")
def flow_channels_swapped(copy):
    copy.edit_flow("flow_backward/000001_000000.flo", lambda uv: uv[:, :, ::-1])


@found_by("flow")
def flow_by_a_twentieth_of_a_pixel(copy):
    copy.edit_flow("flow_forward/000001_000002.flo", lambda uv: np.where(uv < 1e9, uv + 0.05, uv))


@found_by("flow")
def flow_mask_of_all_seen(copy):
    copy.edit("flow_forward/000000_000001_mask.png", lambda mask: mask * 0)


@found_by("flow")
def flow_mask_of_all_occluded(copy):
    masks = [name for name in copy.card["files"]
             if name.startswith("flow_forward/") and name.endswith("_mask.png")]
    most = max(sorted(masks), key=lambda name: (copy.read(name) == 0).sum())
    copy.edit(most, lambda mask: np.where(mask == 0, 1, mask).astype(np.uint8))


@found_by("scene_flow")
def scene_flow_in_world_axes(copy):
    copy.edit("scene_flow/000000_000001.exr",
              lambda m: np.where(np.abs(m) < 1e9, m[..., [1, 2, 0]], m).astype(np.float32))


@found_by("scene_flow")
def scene_flow_a_centimetre_off(copy):
    copy.edit("scene_flow/000001_000002.exr",
              lambda m: np.where(np.abs(m) < 1e9, m + 0.01, m).astype(np.float32))


@found_by("scene_flow")
def scene_flow_unknown(copy):
    copy.edit("scene_flow/000000_000001.exr", lambda m: np.full_like(m, 1e10))


# --- tracks

def edit_tracks(copy, array, function):
    path = copy.folder / f"tracks/000000_{array}.npy"
    values = np.load(path)
    function(values)
    np.save(path, values)


@found_by("tracks")
def tracks_a_fiftieth_of_a_pixel_off(copy):
    def shift(points):
        points[5, 1] += 0.02
    edit_tracks(copy, "points", shift)


@found_by("tracks")
def tracks_of_a_point_that_slides(copy):
    def slide(places):
        places[3, 1:] += 0.01
    edit_tracks(copy, "points_3d", slide)


@found_by("tracks")
def tracks_of_a_point_in_mid_air(copy):
    track = 7
    lens = copy.card["conventions"]["intrinsics"]
    query = np.load(copy.folder / "tracks/000000_query_points.npy")[track]
    camera = copy.card["frames"][int(query[0])]["position"]

    def move(positions):
        positions[track] = (positions[track] + camera) / 2
    edit_tracks(copy, "points_3d", move)
    position = np.load(copy.folder / "tracks/000000_points_3d.npy")[track, 0]

    def project(points):
        for frame in range(points.shape[1]):
            pose = copy.card["frames"][frame]
            x, y, z, w = pose["quaternion_xyzw"]
            v = np.array([x, y, z])
            ray = position - pose["position"]
            # Turned by the conjugate quaternion, from the world into the camera.
            there = ray - 2 * w * np.cross(v, ray) + 2 * np.cross(v, np.cross(v, ray))
            if there[2] >= 0.06:
                points[track, frame] = (lens["fx"] * there[0] / there[2] + lens["cx"],
                                        lens["fy"] * there[1] / there[2] + lens["cy"])
    edit_tracks(copy, "points", project)


@found_by("tracks")
def tracks_all_visible(copy):
    edit_tracks(copy, "occluded", lambda occluded: occluded.fill(False))


@found_by("tracks")
def tracks_one_hidden(copy):
    def hide(occluded):
        occluded[np.argmax((~occluded).all(axis=1))] = True
    edit_tracks(copy, "occluded", hide)


@found_by("tracks")
def tracks_of_other_objects(copy):
    edit_tracks(copy, "object_ids", lambda ids: ids.sort())


@found_by("tracks")
def tracks_with_x_and_y_swapped(copy):
    path = copy.folder / "tracks/000000_query_points.npy"
    np.save(path, np.ascontiguousarray(np.load(path)[:, [0, 2, 1]]))


@found_by("tracks")
def tracks_of_fewer_frames(copy):
    path = copy.folder / "tracks/000000_points.npy"
    np.save(path, np.ascontiguousarray(np.load(path)[:, :-1]))


# --- stereo

@found_by("stereo")
def baseline(copy):
    for modality in ("disparity", "rgb_right", "depth_right"):
        copy.card["conventions"][modality]["baseline_m"] *= 1.02


@found_by("stereo")
def disparity_off_by_a_step(copy):
    copy.edit("disparity/000001.png", lambda image: np.where(image > 0, image + 2, 0)
              .astype(np.uint16))


@found_by("stereo")
def right_picture_is_the_left(copy):
    copy.edit("depth_right/000001.png", lambda _: copy.read("depth/000001.png"))
    copy.edit("rgb_right/000001.png", lambda _: copy.read("rgb/000001.png"))
