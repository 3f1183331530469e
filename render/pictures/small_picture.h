#pragma once

#include "engine/io/files/guarded_folder.h"
#include "engine/scene/class_table.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// How small an image for a web page is.
struct SmallPictureSize {
    int width_px = 320;
    int jpeg_quality = 80;  // 1 .. 100
};

/// The colour of an object's pixels in shown instance images: red, green, blue (sRGB). Neighbouring
/// ids get colours far apart; 0 is black.
[[nodiscard]] std::array<std::uint8_t, 3> shownIdColor(int id);

/// "image/png" for labels, whose colours have to stay exact, else "image/jpeg".
[[nodiscard]] const char* smallPictureType(std::string_view modality);

/// An image of a dataset's folder as people look at it (see shown_picture.h), as the bytes of a
/// small PNG or JPEG file. Empty when the image is gone or damaged.
[[nodiscard]] std::vector<std::uint8_t> encodeSmallPicture(const GuardedFolder& folder,
                                                           const std::string& file,
                                                           std::string_view modality,
                                                           const ClassTable& classes,
                                                           const SmallPictureSize& size);

}  // namespace dollytrack::render
