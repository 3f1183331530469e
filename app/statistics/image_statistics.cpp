#include "app/statistics/image_statistics.h"

#include "app/view/even_frames.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/jobs/parallel.h"
#include "render/pictures/picture_file.h"
#include "render/pictures/small_picture.h"
#include "render/verify/read/frame_images.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace dollytrack::statistics {
namespace {

constexpr double kDepthsPerImage = 4800.0;  // about
// Sizes of example images in order of preference, and the most bytes of one.
constexpr std::array<render::SmallPictureSize, 3> kExampleSizes = {
    {{360, 80}, {256, 70}, {160, 60}}};
constexpr std::size_t kMostExampleBytes = 100'000;

/// The measurements of one frame's images.
struct Measured {
    std::optional<double> luma;
    std::optional<double> colorfulness;
    std::vector<double> depth_m;
    std::size_t unreadable = 0;
};

cv::Mat readImage(const verify::StoredDataset& dataset, const GuardedFolder& folder,
                  const char* modality, int frame, int type) {
    cv::Mat image = render::readPictureFile(folder, verify::imageFile(modality, frame));
    const bool fits = image.type() == type && image.cols == dataset.lens.width &&
                      image.rows == dataset.lens.height;
    return fits ? image : cv::Mat();
}

double deviation(double sum, double squares, double count) {
    return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

/// Sums are whole numbers, so that they are exact.
void measureColor(const cv::Mat& rgb, Measured& into) {
    std::int64_t luma = 0;
    std::int64_t red_green = 0;
    std::int64_t red_green_squares = 0;
    std::int64_t yellow_blue = 0;  // doubled
    std::int64_t yellow_blue_squares = 0;
    for (int y = 0; y < rgb.rows; ++y) {
        const std::uint8_t* pixel = rgb.ptr(y);
        for (int x = 0; x < rgb.cols; ++x, pixel += 3) {
            const int r = pixel[0];
            const int g = pixel[1];
            const int b = pixel[2];
            luma += 54 * r + 183 * g + 19 * b;  // as in PictureQuality
            red_green += r - g;
            red_green_squares += (r - g) * (r - g);
            yellow_blue += r + g - 2 * b;
            yellow_blue_squares += (r + g - 2 * b) * (r + g - 2 * b);
        }
    }
    const auto count = static_cast<double>(rgb.total());
    const auto number = [](std::int64_t value) { return static_cast<double>(value); };
    into.luma = number(luma) / 256.0 / count;
    const double mean = std::hypot(number(red_green), 0.5 * number(yellow_blue)) / count;
    const double spread =
        std::hypot(deviation(number(red_green), number(red_green_squares), count),
                   0.5 * deviation(number(yellow_blue), number(yellow_blue_squares), count));
    into.colorfulness = spread + 0.3 * mean;
}

void measureDepth(const cv::Mat& millimetres, Measured& into) {
    const double pixels = static_cast<double>(millimetres.total());
    const int step = std::max(1, static_cast<int>(std::sqrt(pixels / kDepthsPerImage)));
    for (int y = step / 2; y < millimetres.rows; y += step) {
        for (int x = step / 2; x < millimetres.cols; x += step) {
            const std::uint16_t depth = millimetres.at<std::uint16_t>(y, x);
            if (depth != 0) into.depth_m.push_back(depth / 1000.0);
        }
    }
}

Measured measureFrame(const verify::StoredDataset& dataset, const GuardedFolder& folder,
                      int frame) {
    Measured measured;
    if (dataset.has("rgb")) {
        const cv::Mat rgb = readImage(dataset, folder, "rgb", frame, CV_8UC3);
        rgb.empty() ? static_cast<void>(++measured.unreadable) : measureColor(rgb, measured);
    }
    if (dataset.has("depth")) {
        const cv::Mat depth = readImage(dataset, folder, "depth", frame, CV_16UC1);
        depth.empty() ? static_cast<void>(++measured.unreadable) : measureDepth(depth, measured);
    }
    return measured;
}

}  // namespace

Status measureImages(const verify::StoredDataset& dataset, DatasetStatistics& into,
                     const JobContext& job) {
    if (!dataset.has("rgb") && !dataset.has("depth")) return {};
    const Result<GuardedFolder> folder = GuardedFolder::open(dataset.folder);
    if (!folder) return fail(ErrorCode::BadInput, folder.error().message, folder.error().where);
    const std::vector<int> frames = view::evenlySpaced(kMostImages, dataset.frames.size());
    std::vector<Measured> measured(frames.size());
    parallelFor(frames.size(), [&](std::size_t i) {
        if (!job.cancelled()) measured[i] = measureFrame(dataset, *folder, frames[i]);
    });
    if (job.cancelled()) {
        return fail(ErrorCode::Cancelled, "The page was not made because the job was cancelled.");
    }
    into.images.frames = frames.size();
    for (const Measured& one : measured) {
        into.images.unreadable += one.unreadable;
        if (one.luma) into.of(Quantity::Luma).push_back(*one.luma);
        if (one.colorfulness) into.of(Quantity::Colorfulness).push_back(*one.colorfulness);
        std::vector<double>& depths = into.of(Quantity::Depth);
        depths.insert(depths.end(), one.depth_m.begin(), one.depth_m.end());
    }
    return {};
}

void addExampleImages(const verify::StoredDataset& dataset, DatasetStatistics& into) {
    const Result<GuardedFolder> folder = GuardedFolder::open(dataset.folder);
    if (!folder || !dataset.has("rgb")) {
        into.examples.clear();
        return;
    }
    for (ExampleFrame& example : into.examples) {
        for (const render::SmallPictureSize& size : kExampleSizes) {
            example.jpeg = render::encodeSmallPicture(
                *folder, verify::imageFile("rgb", example.frame), "rgb", dataset.classes(),
                {std::min(size.width_px, dataset.lens.width), size.jpeg_quality});
            if (example.jpeg.size() <= kMostExampleBytes) break;
            example.jpeg.clear();
        }
    }
    std::erase_if(into.examples, [](const ExampleFrame& one) { return one.jpeg.empty(); });
}

}  // namespace dollytrack::statistics
