// Checks the preview video: one image per frame, in order.
#include "engine/io/files/input_file.h"
#include "render/pictures/picture_file.h"
#include "render/verify/check/check_list.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <vector>

namespace dollytrack::verify {
namespace {

constexpr const char* kVideoFile = "preview.mp4";
constexpr double kRate = 0.002;          // relative; the rate is stored as a fraction
constexpr double kVideoFarthest = 12.0;  // mean difference of 255 that compression may cause

class VideoCheck {
  public:
    VideoCheck(const StoredDataset& dataset, Findings& findings)
        : dataset_(dataset), findings_(findings) {}

    void run() {
        // FFmpeg opens by name and would block on a pipe.
        const Result<InputFile> file = openNamedFile(dataset_.folder / kVideoFile);
        if (!file) return add({}, file.error().message, "an MP4");
        cv::VideoCapture video((dataset_.folder / kVideoFile).string(), cv::CAP_FFMPEG);
        if (!video.isOpened()) return add({}, "it cannot be opened", "an MP4");
        checkRate(video.get(cv::CAP_PROP_FPS));
        const int frames = static_cast<int>(dataset_.frames.size());
        int shown = 0;
        for (cv::Mat picture; shown <= frames && video.read(picture); ++shown) {
            if (shown == frames) break;
            compare(shown, picture);
        }
        if (shown != frames || video.grab()) {
            add({}, shown < frames ? fmt::format("{} images", shown) : "more images",
                fmt::format("{}", frames));
        }
    }

  private:
    void add(std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({kVideoFile, frame, {}, std::move(found), std::move(expected)});
    }

    /// A second of the video must be a second of the trajectory.
    void checkRate(double found) {
        std::vector<double> steps;
        for (std::size_t i = 1; i < dataset_.frames.size(); ++i) {
            steps.push_back(dataset_.frames[i].time_s - dataset_.frames[i - 1].time_s);
        }
        if (steps.empty()) return;
        std::ranges::sort(steps);
        // Steps between paths may differ; any matching step is accepted.
        const auto first = std::ranges::lower_bound(steps, 1.0 / found * (1.0 - kRate));
        if (first != steps.end() && *first <= 1.0 / found * (1.0 + kRate)) return;
        add({}, fmt::format("{:.4g} images per second", found),
            fmt::format("{:.4g}, by the frames' times", 1.0 / steps[steps.size() / 2]));
    }

    void compare(int frame, const cv::Mat& picture) {
        const cv::Size size(dataset_.lens.width & ~1, dataset_.lens.height & ~1);
        if (picture.size() != size) {
            return add(frame, fmt::format("{} x {} px", picture.cols, picture.rows),
                       fmt::format("{} x {}", size.width, size.height));
        }
        const cv::Mat rgb =
            render::readPictureFile(dataset_.folder / imageFile("rgb", frame), cv::IMREAD_COLOR);
        // Unreadable images are reported by another check.
        if (rgb.cols < size.width || rgb.rows < size.height) return;
        cv::Mat difference;
        cv::absdiff(picture, rgb(cv::Rect({0, 0}, size)), difference);
        const cv::Scalar mean = cv::mean(difference);
        const double off = (mean[0] + mean[1] + mean[2]) / 3.0;
        if (off <= kVideoFarthest) return;
        add(frame, fmt::format("an image that differs by {:.0f} of 255 from rgb", off),
            fmt::format("at most {:g}", kVideoFarthest));
    }

    const StoredDataset& dataset_;
    Findings& findings_;
};

}  // namespace

CheckWork beginVideo(const Subject& subject, Findings& findings) {
    try {
        VideoCheck(subject.dataset, findings).run();
    } catch (const cv::Exception& error) {
        findings.add({kVideoFile, {}, {}, error.what(), "an MP4"});
    }
    return {};
}

}  // namespace dollytrack::verify
