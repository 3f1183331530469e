// Checks the preview video: one image per frame, in order.
#include "engine/io/files/input_file.h"
#include "render/formats/media/video.h"
#include "render/formats/media/video_decoder.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/image_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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
        Result<InputFile> file = openNamedFile(dataset_.folder / kVideoFile);
        if (!file) return add({}, file.error().message, "an MP4");
        Result<render::VideoDecoder> video = render::VideoDecoder::open(std::move(*file));
        if (!video) return add({}, video.error().message, "an MP4");
        checkRate(video->framesPerSecond());
        const int frames = static_cast<int>(dataset_.frames.size());
        int shown = 0;
        for (; shown <= frames; ++shown) {
            const std::optional<DecodedPicture> picture = video->next();
            if (!picture) break;
            if (shown < frames) compare(shown, *picture);
        }
        if (shown != frames) {
            add({}, shown < frames ? fmt::format("{} images", shown) : "more images",
                fmt::format("{}", frames));
        }
    }

  private:
    void add(std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({kVideoFile, frame, {}, std::move(found), std::move(expected)});
    }

    /// The video must last as long as the trajectory.
    void checkRate(double found) {
        if (dataset_.frames.size() < 2) return;
        const double seconds = dataset_.frames.back().time_s - dataset_.frames.front().time_s;
        const auto steps = static_cast<double>(dataset_.frames.size() - 1);
        const double expected = seconds > 0.0 ? std::clamp(steps / seconds, render::kSlowestVideo,
                                                           render::kFastestVideo)
                                              : render::kFastestVideo;
        if (std::abs(found - expected) <= kRate * expected) return;
        add({}, fmt::format("{:.4g} images per second", found),
            fmt::format("{:.4g}, by the frames' times", expected));
    }

    void compare(int frame, const DecodedPicture& picture) {
        const int width = dataset_.lens.width & ~1;
        const int height = dataset_.lens.height & ~1;
        if (picture.width != width || picture.height != height) {
            return add(frame, fmt::format("{} x {} px", picture.width, picture.height),
                       fmt::format("{} x {}", width, height));
        }
        const Result<Image8> rgb = readImage8(dataset_.folder / imageFile("rgb", frame), 3);
        // Unreadable images are reported by another check.
        if (!rgb || rgb->width < width || rgb->height < height) return;
        std::int64_t sum = 0;
        const auto row = static_cast<std::size_t>(3 * width);
        for (int y = 0; y < height; ++y) {
            const std::uint8_t* a = picture.data.data() + static_cast<std::size_t>(y) * row;
            const std::uint8_t* b = rgb->values.data() + static_cast<std::size_t>(y) *
                                                             static_cast<std::size_t>(rgb->width) *
                                                             3;
            for (std::size_t i = 0; i < row; ++i) sum += std::abs(a[i] - b[i]);
        }
        const double off = static_cast<double>(sum) / static_cast<double>(picture.data.size());
        if (off <= kVideoFarthest) return;
        add(frame, fmt::format("an image that differs by {:.0f} of 255 from rgb", off),
            fmt::format("at most {:g}", kVideoFarthest));
    }

    const StoredDataset& dataset_;
    Findings& findings_;
};

}  // namespace

CheckWork beginVideo(const Subject& subject, Findings& findings) {
    VideoCheck(subject.dataset, findings).run();
    return {};
}

}  // namespace dollytrack::verify
