#include "app/editor/viewport/picture_saver.h"

#include "engine/core/log.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/png_writer.h"
#include "ui/viewport/false_color.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

namespace dollytrack::editor {
namespace {

/// Pixels in PNG layout.
struct Pixels {
    PngFormat format = PngFormat::Rgb8;
    std::vector<std::uint8_t> bytes;
};

Pixels gray16(const std::vector<std::uint16_t>& values) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());  // NOLINT
    return {PngFormat::Gray16, {first, first + 2 * values.size()}};
}

Pixels pixelsOf(const ui::PreviewImage& image) {
    const render::FrameRecord& record = image.record;
    switch (image.modality) {
        case ui::Modality::Rgb:
            return {PngFormat::Rgb8, record.rgb};
        case ui::Modality::Depth:
            return gray16(render::depthInMillimetres(record.depth_m));
        case ui::Modality::Instance:
            return gray16(record.instance);
        case ui::Modality::Semantic:
            return {render::classFormat(record.classes()),
                    render::classBytes(record.classes(), record.semantic)};
        case ui::Modality::Normal:
            break;
    }
    // Uses the camera of the image; the project's may have changed since.
    const std::vector<std::uint8_t> rgba = ui::falseColor(record, image.view, image.modality);
    Pixels pixels;
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        if (i % 4 != 3) pixels.bytes.push_back(rgba[i]);
    }
    return pixels;
}

Status write(const std::filesystem::path& file, const ui::PreviewImage& image) {
    const Pixels pixels = pixelsOf(image);
    return encodePng(image.record.width, image.record.height, pixels.format, pixels.bytes)
        .and_then([&](const std::vector<std::uint8_t>& png) -> Status {
            return writeWhole(file, std::span<const std::uint8_t>(png));
        });
}

}  // namespace

PictureSaver::PictureSaver(std::function<void()> wake) : writer_(std::move(wake)) {}

PictureSaver::~PictureSaver() {
    writer_.finish();
}

void PictureSaver::save(const std::filesystem::path& file, ui::PreviewImage image) {
    orders_->put({file, std::move(image)});
    // A newer task replaces a waiting one, so each task takes all orders.
    writer_.start([orders = orders_, failed = failed_](const JobContext&) {
        for (const Order& order : orders->takeAll()) {
            Status written = write(order.file, order.image);
            if (written) {
                log::info("editor", "saved " + order.file.string());
            } else {
                failed->put(std::move(written.error()));
            }
        }
    });
}

std::optional<Error> PictureSaver::takeError() {
    std::ranges::move(failed_->takeAll(), std::back_inserter(errors_));
    if (errors_.empty()) return std::nullopt;
    Error first = std::move(errors_.front());
    errors_.erase(errors_.begin());
    return first;
}

}  // namespace dollytrack::editor
