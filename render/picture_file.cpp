#include "render/picture_file.h"

#include "engine/io/text_file.h"

#include <opencv2/imgcodecs.hpp>

namespace dollytrack::render {

cv::Mat readPictureFile(const std::filesystem::path& path, int flags) {
    const Result<std::string> bytes = io::readText(path);
    if (!bytes || bytes->empty()) return {};
    const cv::Mat raw(1, static_cast<int>(bytes->size()), CV_8UC1,
                      const_cast<char*>(bytes->data()));
    try {
        return cv::imdecode(raw, flags);
    } catch (const cv::Exception&) {
        return {};
    }
}

}  // namespace dollytrack::render
