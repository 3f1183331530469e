#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// One object's mask in one image as COCO run lengths: column by column, alternating between
/// outside and inside, starting outside.
struct ObjectMask {
    int object_id = 0;
    std::vector<std::uint32_t> counts;       // sums to width * height
    std::uint32_t area = 0;                  // px
    std::array<int, 4> bbox = {0, 0, 0, 0};  // x, y, width, height; [0,0,1,1] is the first pixel
};

/// Masks of all objects in an id image, by increasing id. 0 is no object.
[[nodiscard]] std::vector<ObjectMask> objectMasks(int width, int height,
                                                  std::span<const std::uint16_t> ids);

/// COCO's compressed run-length text.
[[nodiscard]] std::string compressCounts(std::span<const std::uint32_t> counts);

/// Inverse of compressCounts(); empty for invalid text.
[[nodiscard]] std::vector<std::uint32_t> decompressCounts(std::string_view text);

}  // namespace dollytrack::render
