#include "app/editor/viewport/picture_file.h"

#include "engine/io/files/text_file.h"
#include "engine/io/pictures/picture_decoder.h"

#include <utility>

namespace dollytrack::editor {

PictureFile::PictureFile(std::function<void()> wake) : reader_(std::move(wake)) {}
PictureFile::~PictureFile() = default;

void PictureFile::show(const std::filesystem::path& file) {
    file_ = file;
    texture_.reset();
    message_ = "reading …";
    reader_.start([file, latest = read_](const JobContext&) {
        constexpr int kLargest = 8192;
        Pixels pixels;
        Texture picture;
        const Result<std::string> bytes = readText(file);
        if (bytes && decodePicture(std::span(reinterpret_cast<const std::uint8_t*>(bytes->data()),
                                             bytes->size()),
                                   kLargest, true, picture)) {
            pixels = {picture.width, picture.height, std::move(picture.rgba)};
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
