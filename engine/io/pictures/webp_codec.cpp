#include "engine/io/pictures/codecs.h"

#include <webp/decode.h>

namespace dollytrack {

std::optional<DecodedPicture> unpackWebp(PictureBytes bytes) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) {
        return std::nullopt;
    }
    DecodedPicture picture;
    if (!makeRoom(features.width, features.height, 4, 8, picture)) return std::nullopt;
    if (WebPDecodeRGBAInto(bytes.data(), bytes.size(), picture.data.data(), picture.data.size(),
                           4 * picture.width) == nullptr) {
        return std::nullopt;
    }
    return picture;
}

}  // namespace dollytrack
