#include "engine/io/pictures/codecs.h"

#include <algorithm>
#include <limits>
#include <memory>

#define STBI_NO_STDIO
#define STBI_NO_PNG
#define STBI_NO_JPEG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace dollytrack {

std::optional<DecodedPicture> unpackOther(PictureBytes bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return std::nullopt;
    }
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    DecodedPicture picture;
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 ||
        !makeRoom(width, height, channels, 8, picture)) {
        return std::nullopt;
    }
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, picture.channels),
        &stbi_image_free);
    if (!pixels || width != picture.width || height != picture.height) return std::nullopt;
    std::copy_n(pixels.get(), picture.data.size(), picture.data.begin());
    return picture;
}

}  // namespace dollytrack
