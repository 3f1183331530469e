#include "render/dataset/contact_sheet.h"

#include "engine/jobs/parallel.h"
#include "render/dataset/picture_file.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <string_view>

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

/// Near (large disparity) is bright; black is no surface.
cv::Mat disparityPicture(const cv::Mat& disparity) {
    double largest = 1.0;
    cv::minMaxLoc(disparity, nullptr, &largest);
    cv::Mat grey;
    disparity.convertTo(grey, CV_8U, 215.0 / std::max(largest, 1.0), 40.0);
    grey.setTo(0, disparity == 0);
    cv::Mat bgr;
    cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
    return bgr;
}

/// Near is bright; black is no surface.
cv::Mat depthPicture(const cv::Mat& millimetres) {
    double farthest = 1.0;
    cv::minMaxLoc(millimetres, nullptr, &farthest);
    cv::Mat grey;
    millimetres.convertTo(grey, CV_8U, -215.0 / std::max(farthest, 1.0), 255.0);
    grey.setTo(0, millimetres == 0);
    cv::Mat bgr;
    cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
    return bgr;
}

/// Hues of consecutive ids differ by the golden angle.
cv::Vec3b idColor(int id) {
    if (id == 0) return {0, 0, 0};
    const int hue = static_cast<int>(static_cast<unsigned>(id) * 137U % 360U);
    const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(hue / 2, 150, 170 + id * 29 % 80));
    cv::Mat bgr;
    cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
    return bgr.at<cv::Vec3b>(0, 0);
}

cv::Vec3b classColor(const ClassTable& classes, int id) {
    const DatasetClass* found = classes.find(id);
    if (found == nullptr) return {0, 0, 0};
    return {found->color[2], found->color[1], found->color[0]};
}

template <class Value, class Color>
cv::Mat labelPicture(const cv::Mat& labels, const Color& color) {
    std::vector<std::pair<bool, cv::Vec3b>> known(1UL << (8 * sizeof(Value)));
    cv::Mat bgr(labels.size(), CV_8UC3);
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            const Value label = labels.at<Value>(y, x);
            auto& [done, value] = known[label];
            if (!done) value = color(label);
            done = true;
            bgr.at<cv::Vec3b>(y, x) = value;
        }
    }
    return bgr;
}

/// Converts an image that was read unchanged to 8-bit BGR.
cv::Mat pictureOf(const cv::Mat& image, std::string_view modality, const ClassTable& classes) {
    const auto of_class = [&](int id) { return classColor(classes, id); };
    if (image.type() == CV_8UC3) return image;
    if (image.type() == CV_16UC3) {  // normals, object coordinates
        cv::Mat bgr;
        image.convertTo(bgr, CV_8U, 1.0 / 257.0);
        return bgr;
    }
    if (image.type() == CV_16UC1) {
        if (modality.starts_with("depth")) return depthPicture(image);
        if (modality == "disparity") return disparityPicture(image);
        if (modality == "semantic") return labelPicture<std::uint16_t>(image, of_class);
        return labelPicture<std::uint16_t>(image, idColor);
    }
    return labelPicture<std::uint8_t>(image, of_class);
}

/// Empty if the file is missing or damaged. Labels are resampled without blending.
cv::Mat thumbnail(const io::GuardedFolder& folder, const std::string& file,
                  std::string_view modality, const ClassTable& classes) {
    try {
        const cv::Mat image = readPictureFile(folder, file, cv::IMREAD_UNCHANGED);
        if (image.empty()) return {};
        const int height = std::max(1, kThumbWidth * image.rows / image.cols);
        const bool labels = modality == "instance" || modality == "semantic";
        cv::Mat small;
        cv::resize(pictureOf(image, modality, classes), small, {kThumbWidth, height}, 0, 0,
                   labels ? cv::INTER_NEAREST : cv::INTER_AREA);
        return small;
    } catch (const cv::Exception&) {
        return {};
    }
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

Result<std::vector<std::uint8_t>> encodeContactSheet(const io::GuardedFolder& folder,
                                                     const std::vector<SheetPicture>& pictures,
                                                     const Modality& modality,
                                                     const ClassTable& classes,
                                                     const std::string& title) {
    std::vector<cv::Mat> thumbs(pictures.size());
    parallelFor(pictures.size(), [&](std::size_t i) {
        thumbs[i] = thumbnail(folder, pictures[i].file, modality.name, classes);
    });
    int thumb_height = 1;
    for (std::size_t i = 0; i < thumbs.size(); ++i) {
        if (thumbs[i].empty()) {
            return fail(ErrorCode::BadInput, "the image was damaged or removed during the export",
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
                 cv::Scalar(32, 30, 28));
    writeText(page, title, kGap, 29, 0.65, 235);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int place = static_cast<int>(i);
        const int x = kGap + place % columns * step_x;
        const int y = kTitle + place / columns * step_y;
        thumbs[i].copyTo(page(cv::Rect(x, y, thumbs[i].cols, thumbs[i].rows)));
        writeText(page, pictures[i].caption, x + 2, y + thumb_height + 16, 0.45, 200);
    }
    std::vector<std::uint8_t> bytes;
    try {
        cv::imencode(".jpg", page, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
    } catch (const cv::Exception& problem) {
        return fail(ErrorCode::Failed, std::string("the contact sheet: ") + problem.what());
    }
    return bytes;
}

}  // namespace dollytrack::render
