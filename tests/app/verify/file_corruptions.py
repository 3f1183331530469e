"""Damages files and the form of images: hashes, missing and foreign files, sizes and types."""
import numpy as np

from corruptions import found_by


@found_by("files")
def hash_of_one_byte(copy):
    copy.mended = False
    copy.edit_bytes("frames.csv", lambda data: data[:-3] + b"9" + data[-2:])


@found_by("files")
def other_licences(copy):
    copy.mended = False
    copy.edit_bytes("LICENSES", lambda data: data.replace(b"CC-BY", b"CC-0"))


@found_by("files")
def missing_licences(copy):
    copy.mended = False
    (copy.folder / "LICENSES").unlink()


@found_by("files")
def missing_frame(copy):
    copy.remove("instance/000002.png")


@found_by("files")
def missing_flow(copy):
    copy.remove("flow_forward/000001_000002.flo")


@found_by("files")
def foreign_file(copy):
    (copy.folder / "rgb" / "999999.png").write_bytes(b"")


@found_by("images")
def one_byte_of_a_png(copy):
    def flip(data):
        data[len(data) // 2] ^= 0x10
        return data
    copy.edit_bytes("depth/000001.png", flip)


@found_by("images")
def truncated_png(copy):
    copy.edit_bytes("rgb/000001.png", lambda data: data[:len(data) * 2 // 3])


@found_by("images")
def other_size(copy):
    copy.edit("semantic/000000.png", lambda image: image[:, :-1])


@found_by("images")
def other_type(copy):
    copy.edit("depth/000000.png", lambda image: (image // 256).astype(np.uint8))


@found_by("images")
def truncated_exr(copy):
    copy.edit_bytes("depth_exr/000001.exr", lambda data: data[:200])
