#include "render/dataset/picture_file.h"

#include "engine/io/files/text_file.h"

#include <opencv2/imgcodecs.hpp>

namespace dollytrack::render {
namespace {

cv::Mat decodePicture(const Result<std::string>& bytes, int flags) {
    if (!bytes || bytes->empty()) return {};
    const cv::Mat raw(1, static_cast<int>(bytes->size()), CV_8UC1,
                      const_cast<char*>(bytes->data()));
    try {
        return cv::imdecode(raw, flags);
    } catch (const cv::Exception&) {
        return {};
    }
}

}  // namespace

cv::Mat readPictureFile(const std::filesystem::path& path, int flags) {
    return decodePicture(io::readText(path), flags);
}

cv::Mat readPictureFile(const io::GuardedFolder& folder, const std::string& name, int flags) {
    const Result<io::InputFile> file = folder.openInput(name);
    return file ? decodePicture(file->readAll(io::kMostTextBytes), flags) : cv::Mat();
}

}  // namespace dollytrack::render
