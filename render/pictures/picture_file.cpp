#include "render/pictures/picture_file.h"

#include "engine/io/files/text_file.h"
#include "engine/io/pictures/codecs.h"

namespace dollytrack::render {
namespace {

cv::Mat decodePicture(const Result<std::string>& bytes) {
    if (!bytes) return {};
    std::optional<DecodedPicture> picture =
        unpackPicture({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
    if (!picture) return {};
    const int depth = picture->bits == 16 ? CV_16U : CV_8U;
    return cv::Mat(picture->height, picture->width, CV_MAKETYPE(depth, picture->channels),
                   picture->data.data())
        .clone();
}

}  // namespace

cv::Mat readPictureFile(const std::filesystem::path& path) {
    return decodePicture(readText(path));
}

cv::Mat readPictureFile(const GuardedFolder& folder, const std::string& name) {
    const Result<InputFile> file = folder.openInput(name);
    return file ? decodePicture(file->readAll(kMostTextBytes)) : cv::Mat();
}

}  // namespace dollytrack::render
