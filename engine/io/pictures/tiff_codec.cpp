#include "engine/io/pictures/codecs.h"

#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace dollytrack {
namespace {

struct TiffSource {
    PictureBytes bytes;
    std::size_t at = 0;
};

tmsize_t readBytes(thandle_t handle, void* into, tmsize_t size) {
    auto& source = *static_cast<TiffSource*>(handle);
    const std::size_t left = source.bytes.size() - std::min(source.at, source.bytes.size());
    const std::size_t count = std::min(left, static_cast<std::size_t>(std::max<tmsize_t>(size, 0)));
    if (count > 0) std::memcpy(into, source.bytes.data() + source.at, count);
    source.at += count;
    return static_cast<tmsize_t>(count);
}

tmsize_t writeNothing(thandle_t, void*, tmsize_t) {
    return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int from) {
    auto& source = *static_cast<TiffSource*>(handle);
    const std::size_t base = from == SEEK_CUR   ? source.at
                             : from == SEEK_END ? source.bytes.size()
                                                : 0;
    source.at = base + offset;
    return source.at;
}

int closeNothing(thandle_t) {
    return 0;
}

toff_t sizeOf(thandle_t handle) {
    return static_cast<TiffSource*>(handle)->bytes.size();
}

}  // namespace

std::optional<DecodedPicture> unpackTiff(PictureBytes bytes) {
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    TiffSource source{bytes};
    const std::unique_ptr<TIFF, decltype(&TIFFClose)> file(
        TIFFClientOpen("picture", "rm", &source, readBytes, writeNothing, seek, closeNothing,
                       sizeOf, nullptr, nullptr),
        &TIFFClose);
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    if (!file || TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) != 1 ||
        TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height) != 1) {
        return std::nullopt;
    }
    DecodedPicture picture;
    if (!makeRoom(width, height, 4, 8, picture)) return std::nullopt;
    std::vector<std::uint32_t> raster(picture.data.size() / 4);
    if (TIFFReadRGBAImageOriented(file.get(), width, height, raster.data(), ORIENTATION_TOPLEFT,
                                  1) != 1) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < raster.size(); ++i) {
        picture.data[4 * i] = static_cast<std::uint8_t>(TIFFGetR(raster[i]));
        picture.data[4 * i + 1] = static_cast<std::uint8_t>(TIFFGetG(raster[i]));
        picture.data[4 * i + 2] = static_cast<std::uint8_t>(TIFFGetB(raster[i]));
        picture.data[4 * i + 3] = static_cast<std::uint8_t>(TIFFGetA(raster[i]));
    }
    return picture;
}

}  // namespace dollytrack
