#include "render/dataset/contact_sheet.h"

#include "engine/io/files/jpeg_writer.h"
#include "engine/jobs/parallel.h"
#include "render/pictures/shown_picture.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace dollytrack::render {
namespace {

constexpr int kMaxPictures = 24;
constexpr int kColumns = 6;
constexpr int kThumbWidth = 320;
constexpr int kGap = 8;
constexpr int kCaption = 22;
constexpr int kTitle = 44;

void writeText(cv::Mat& page, const std::string& text, int x, int y, double size, int grey) {
    cv::putText(page, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(grey), 1,
                cv::LINE_AA);
}

}  // namespace

std::vector<int> chooseSheetFrames(const std::vector<bool>& is_key) {
    std::vector<int> frames;
    const bool enough_keys = std::count(is_key.begin(), is_key.end(), true) >= kMaxPictures / 2;
    for (std::size_t i = 0; i < is_key.size(); ++i) {
        if (is_key[i] || !enough_keys) frames.push_back(static_cast<int>(i));
    }
    const std::size_t count = std::min<std::size_t>(frames.size(), kMaxPictures);
    std::vector<int> chosen;
    for (std::size_t i = 0; i < count; ++i) {
        // Includes the first and the last.
        chosen.push_back(frames[count == 1 ? 0 : i * (frames.size() - 1) / (count - 1)]);
    }
    return chosen;
}

Result<std::vector<std::uint8_t>> encodeContactSheet(const GuardedFolder& folder,
                                                     const std::vector<SheetPicture>& pictures,
                                                     const Modality& modality,
                                                     const ClassTable& classes,
                                                     const std::string& title) {
    std::vector<cv::Mat> thumbs(pictures.size());
    parallelFor(pictures.size(), [&](std::size_t i) {
        thumbs[i] = readShownPicture(folder, pictures[i].file, modality.name, classes, kThumbWidth);
    });
    int thumb_height = 1;
    for (std::size_t i = 0; i < thumbs.size(); ++i) {
        if (thumbs[i].empty()) {
            return fail(
                ErrorCode::BadInput,
                "the image cannot be read back: it was damaged or removed during the export, "
                "or too few files may be open at once (ulimit -n)",
                (folder.path() / pictures[i].file).string());
        }
        thumb_height = std::max(thumb_height, thumbs[i].rows);
    }
    const int count = std::max<int>(static_cast<int>(pictures.size()), 1);
    const int columns = std::min(kColumns, count);
    const int rows = (count + columns - 1) / columns;
    const int step_x = kThumbWidth + kGap;
    const int step_y = thumb_height + kCaption + kGap;
    cv::Mat page(kTitle + rows * step_y + kGap, columns * step_x + kGap, CV_8UC3,
                 cv::Scalar(28, 30, 32));
    writeText(page, title, kGap, 29, 0.65, 235);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int place = static_cast<int>(i);
        const int x = kGap + place % columns * step_x;
        const int y = kTitle + place / columns * step_y;
        thumbs[i].copyTo(page(cv::Rect(x, y, thumbs[i].cols, thumbs[i].rows)));
        writeText(page, pictures[i].caption, x + 2, y + thumb_height + 16, 0.45, 200);
    }
    auto bytes =
        encodeJpeg(page.cols, page.rows, 3, 90, {page.data, page.total() * page.elemSize()});
    if (!bytes) return fail(ErrorCode::Failed, bytes.error().message, "contact_sheet.jpg");
    return bytes;
}

}  // namespace dollytrack::render
