#include "app/editor/viewport/picture_file.h"

#include "render/pictures/picture_file.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace dollytrack::editor {

PictureFile::PictureFile(std::function<void()> wake) : reader_(std::move(wake)) {}
PictureFile::~PictureFile() = default;

void PictureFile::show(const std::filesystem::path& file) {
    file_ = file;
    texture_.reset();
    message_ = "reading …";
    reader_.start([file, latest = read_](const JobContext&) {
        Pixels pixels;
        try {
            cv::Mat picture = render::readPictureFile(file, cv::IMREAD_COLOR);
            constexpr int kLargest = 8192;
            if (const int longer = std::max(picture.cols, picture.rows); longer > kLargest) {
                cv::resize(picture, picture, {}, static_cast<double>(kLargest) / longer,
                           static_cast<double>(kLargest) / longer, cv::INTER_AREA);
            }
            if (!picture.empty()) {
                cv::cvtColor(picture, picture, cv::COLOR_BGR2RGBA);
                pixels.width = picture.cols;
                pixels.height = picture.rows;
                pixels.rgba.assign(picture.datastart, picture.dataend);
            }
        } catch (const cv::Exception&) {
            pixels = {};
        }
        latest->put(std::move(pixels));
    });
}

void PictureFile::close() {
    file_.clear();
}

ui::ImageViewerView PictureFile::view() {
    // Not in close(), because the current frame still shows it.
    if (!isOpen()) texture_.reset();
    if (std::optional<Pixels> pixels = read_->take(); pixels && isOpen()) {
        if (pixels->rgba.empty()) {
            message_ = "The image " + file_.string() + " cannot be read.";
        } else {
            message_.clear();
            texture_.upload(pixels->width, pixels->height, pixels->rgba);
        }
    }
    ui::ImageViewerView view;
    view.texture = texture_.get();
    view.width = texture_.width();
    view.height = texture_.height();
    view.title = file_.filename().string();
    view.message = message_;
    return view;
}

}  // namespace dollytrack::editor
