#include "app/statistics/dataset_measurements.h"

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

constexpr double kDepthsPerImage = 4800.0;  // at least, if it has so many pixels
// Sizes of example images in order of preference, and the most bytes of one.
constexpr std::array<render::SmallPictureSize, 3> kExampleSizes = {
    {{360, 80}, {256, 70}, {160, 60}}};
constexpr std::size_t kMostExampleBytes = 100'000;

/// The measurements of one frame's images.
struct Measured {
    std::optional<double> luma;
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

/// The mean luma of an image, 0 to 255. The sum is of whole numbers, so that it is exact.
double meanLuma(const cv::Mat& rgb) {
    std::int64_t luma = 0;
    for (int y = 0; y < rgb.rows; ++y) {
        const std::uint8_t* pixel = rgb.ptr(y);
        for (int x = 0; x < rgb.cols; ++x, pixel += 3) {
            luma += 54 * pixel[0] + 183 * pixel[1] + 19 * pixel[2];  // as in PictureQuality
        }
    }
    return static_cast<double>(luma) / 256.0 / static_cast<double>(rgb.total());
}

void measureDepth(const cv::Mat& millimetres, Measured& measured) {
    const double pixels = static_cast<double>(millimetres.total());
    const int step = std::max(1, static_cast<int>(std::sqrt(pixels / kDepthsPerImage)));
    for (int y = step / 2; y < millimetres.rows; y += step) {
        for (int x = step / 2; x < millimetres.cols; x += step) {
            const std::uint16_t depth = millimetres.at<std::uint16_t>(y, x);
            if (depth != 0) measured.depth_m.push_back(depth / 1000.0);
        }
    }
}

Measured measureFrame(const verify::StoredDataset& dataset, const GuardedFolder& folder,
                      int frame) {
    Measured measured;
    if (dataset.has("rgb")) {
        const cv::Mat rgb = readImage(dataset, folder, "rgb", frame, CV_8UC3);
        if (rgb.empty()) {
            ++measured.unreadable;
        } else {
            measured.luma = meanLuma(rgb);
        }
    }
    if (dataset.has("depth")) {
        const cv::Mat depth = readImage(dataset, folder, "depth", frame, CV_16UC1);
        if (depth.empty()) {
            ++measured.unreadable;
        } else {
            measureDepth(depth, measured);
        }
    }
    return measured;
}

}  // namespace

Status measureImages(const verify::StoredDataset& dataset, std::size_t count,
                     DatasetStatistics& statistics, const JobContext& job) {
    if (!dataset.has("rgb") && !dataset.has("depth")) return {};
    const Result<GuardedFolder> folder = GuardedFolder::open(dataset.folder);
    if (!folder) return fail(ErrorCode::BadInput, folder.error().message, folder.error().where);
    const std::vector<int> frames = view::evenlySpaced(count, dataset.frames.size());
    std::vector<Measured> measured(frames.size());
    parallelFor(frames.size(), [&](std::size_t i) {
        if (!job.cancelled()) measured[i] = measureFrame(dataset, *folder, frames[i]);
    });
    if (job.cancelled()) {
        return fail(ErrorCode::Cancelled, "The page was not made because the job was cancelled.");
    }
    statistics.image_frames = frames.size();
    for (const Measured& frame : measured) {
        statistics.images_unreadable += frame.unreadable;
        if (frame.luma) statistics.valuesOf(Quantity::Luma).push_back(*frame.luma);
        std::vector<double>& depths = statistics.valuesOf(Quantity::Depth);
        depths.insert(depths.end(), frame.depth_m.begin(), frame.depth_m.end());
    }
    return {};
}

void addExampleImages(const verify::StoredDataset& dataset, DatasetStatistics& statistics) {
    const Result<GuardedFolder> folder = GuardedFolder::open(dataset.folder);
    if (!folder || !dataset.has("rgb")) {
        statistics.examples.clear();
        return;
    }
    for (ExampleFrame& example : statistics.examples) {
        for (const render::SmallPictureSize& size : kExampleSizes) {
            example.jpeg = render::encodeSmallPicture(
                *folder, verify::imageFile("rgb", example.frame), "rgb", dataset.classes(),
                {std::min(size.width_px, dataset.lens.width), size.jpeg_quality});
            if (example.jpeg.size() <= kMostExampleBytes) break;
            example.jpeg.clear();
        }
    }
    std::erase_if(statistics.examples,
                  [](const ExampleFrame& example) { return example.jpeg.empty(); });
}

}  // namespace dollytrack::statistics
