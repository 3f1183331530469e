"""Damages colour images: rgb, the preview video and base colours."""
import cv2
import numpy as np

from corruptions import found_by


# --- rgb

@found_by("usable")
def black_picture(copy):
    copy.edit("rgb/000001.png", lambda image: image * 0)


@found_by("usable")
def dark_rate_of_another_dataset(copy):
    copy.card["metrics"]["pictures"]["dark_rate"] = 0.5


@found_by("pictures")
def pictures_one_too_late(copy):
    earlier = copy.read("rgb/000000.png")
    for name in sorted(path.name for path in (copy.folder / "rgb").iterdir())[1:]:
        picture = copy.read(f"rgb/{name}")
        copy.write(f"rgb/{name}", earlier)
        earlier = picture


@found_by("pictures")
def pictures_of_two_frames_exchanged(copy):
    copy.swap("rgb/000001.png", "rgb/000003.png")


@found_by("pictures")
def picture_mirrored(copy):
    copy.edit("rgb/000001.png", lambda image: image[:, ::-1])


@found_by("pictures")
def picture_upside_down(copy):
    copy.edit("rgb/000004.png", lambda image: image[::-1])


@found_by("pictures")
def picture_moved_by_eight_pixels(copy):
    copy.edit("rgb/000001.png", lambda image: np.roll(image, (8, 8), (0, 1)))


@found_by("pictures")
def picture_of_another_room(copy):
    def draw(image):
        other = np.full_like(image, 90)
        for i, x in enumerate(range(5, image.shape[1] - 20, 24)):
            cv2.rectangle(other, (x, 7 * i % 50), (x + 9, 60 + 11 * i % 50), (20 * i, 200, 60), -1)
        return other
    copy.edit("rgb/000001.png", draw)


@found_by("pictures")
def picture_black(copy):
    copy.edit("rgb/000001.png", np.zeros_like)


# --- preview video

def read_video(path):
    video, pictures = cv2.VideoCapture(str(path)), []
    while True:
        good, picture = video.read()
        if not good:
            return pictures
        pictures.append(picture)


def edit_video(copy, function, speed=1.0):
    """Rewrites the video with changed images; `speed` multiplies its frame rate."""
    path = copy.folder / "preview.mp4"
    rate = speed * cv2.VideoCapture(str(path)).get(cv2.CAP_PROP_FPS)
    pictures = function(read_video(path))
    height, width = pictures[0].shape[:2]
    video = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"mp4v"), rate, (width, height))
    for picture in pictures:
        video.write(picture)
    video.release()


@found_by("video")
def video_without_its_last_picture(copy):
    edit_video(copy, lambda pictures: pictures[:-1])


@found_by("video")
def video_backwards(copy):
    edit_video(copy, lambda pictures: pictures[::-1])


@found_by("video")
def video_at_twice_the_speed(copy):
    edit_video(copy, lambda pictures: pictures, speed=2.0)


@found_by("video")
def video_cut_off(copy):
    copy.edit_bytes("preview.mp4", lambda data: data[:len(data) // 2])


# --- base colours

@found_by("albedo")
def albedo_as_it_is_lit(copy):
    copy.write("albedo/000001.png", copy.read("rgb/000001.png"))


@found_by("albedo")
def albedo_linear(copy):
    copy.edit("albedo/000001.png",
              lambda image: np.round(255 * (image / 255.0) ** 2.2).astype(np.uint8))
