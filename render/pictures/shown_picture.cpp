#include "render/pictures/shown_picture.h"

#include "render/pictures/picture_file.h"
#include "render/pictures/small_picture.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace dollytrack::render {
namespace {

constexpr int kTallest = 1 << 13;  // px; a damaged image of one column would take gigabytes

/// Disparity is bright where it is large, near; black is nothing.
cv::Mat disparityPicture(const cv::Mat& disparity) {
    double largest = 1.0;
    cv::minMaxLoc(disparity, nullptr, &largest);
    cv::Mat grey;
    disparity.convertTo(grey, CV_8U, 215.0 / std::max(largest, 1.0), 40.0);
    grey.setTo(0, disparity == 0);
    cv::Mat rgb;
    cv::cvtColor(grey, rgb, cv::COLOR_GRAY2RGB);
    return rgb;
}

/// Bright is near; black is nothing.
cv::Mat depthPicture(const cv::Mat& millimetres) {
    double farthest = 1.0;
    cv::minMaxLoc(millimetres, nullptr, &farthest);
    cv::Mat grey;
    millimetres.convertTo(grey, CV_8U, -215.0 / std::max(farthest, 1.0), 255.0);
    grey.setTo(0, millimetres == 0);
    cv::Mat rgb;
    cv::cvtColor(grey, rgb, cv::COLOR_GRAY2RGB);
    return rgb;
}

/// Neighbouring ids get colours far apart: hues a golden angle from each other.
cv::Vec3b idColor(int id) {
    if (id == 0) return {0, 0, 0};
    const int hue = static_cast<int>(static_cast<unsigned>(id) * 137U % 360U);
    const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(hue / 2, 150, 170 + id * 29 % 80));
    cv::Mat rgb;
    cv::cvtColor(hsv, rgb, cv::COLOR_HSV2RGB);
    return rgb.at<cv::Vec3b>(0, 0);
}

cv::Vec3b classColor(const ClassTable& classes, int id) {
    const DatasetClass* found = classes.find(id);
    if (found == nullptr) return {0, 0, 0};
    return {found->color[0], found->color[1], found->color[2]};
}

template <class Value, class Color>
cv::Mat labelPicture(const cv::Mat& labels, const Color& color) {
    std::vector<std::pair<bool, cv::Vec3b>> known(1UL << (8 * sizeof(Value)));
    cv::Mat rgb(labels.size(), CV_8UC3);
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            const Value label = labels.at<Value>(y, x);
            auto& [done, value] = known[label];
            if (!done) value = color(label);
            done = true;
            rgb.at<cv::Vec3b>(y, x) = value;
        }
    }
    return rgb;
}

bool showsLabels(std::string_view modality) {
    return modality == "instance" || modality == "semantic";
}

}  // namespace

std::array<std::uint8_t, 3> shownIdColor(int id) {
    const cv::Vec3b rgb = idColor(id);
    return {rgb[0], rgb[1], rgb[2]};
}

cv::Mat shownPicture(const cv::Mat& image, std::string_view modality, const ClassTable& classes) {
    const auto of_class = [&](int id) { return classColor(classes, id); };
    if (image.type() == CV_8UC3) return image;
    if (image.type() == CV_16UC3) {  // normals, places in an object
        cv::Mat rgb;
        image.convertTo(rgb, CV_8U, 1.0 / 257.0);
        return rgb;
    }
    if (image.type() == CV_16UC1) {
        if (modality.starts_with("depth")) return depthPicture(image);
        if (modality == "disparity") return disparityPicture(image);
        if (modality == "semantic") return labelPicture<std::uint16_t>(image, of_class);
        return labelPicture<std::uint16_t>(image, idColor);
    }
    return labelPicture<std::uint8_t>(image, of_class);
}

cv::Mat readShownPicture(const GuardedFolder& folder, const std::string& file,
                         std::string_view modality, const ClassTable& classes, int width_px) {
    try {
        const cv::Mat image = readPictureFile(folder, file);
        if (image.empty()) return {};
        const int height = std::max(1, width_px * image.rows / image.cols);
        if (height > kTallest) return {};
        cv::Mat small;
        cv::resize(shownPicture(image, modality, classes), small, {width_px, height}, 0, 0,
                   showsLabels(modality) ? cv::INTER_NEAREST : cv::INTER_AREA);
        return small;
    } catch (const cv::Exception&) {
        return {};
    }
}

}  // namespace dollytrack::render
