#include "app/view/frame_pictures.h"

#include "app/view/base64.h"
#include "app/view/even_frames.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/jobs/parallel.h"
#include "render/verify/read/frame_images.h"

#include <algorithm>
#include <array>

namespace dollytrack::view {
namespace {

using render::SmallPictureSize;

struct ShownModality {
    const char* name;
    const char* text;
};
constexpr std::array<ShownModality, 6> kShown = {{{"rgb", "Colour"},
                                                  {"rgb_sensor", "Sensor colour"},
                                                  {"depth", "Depth"},
                                                  {"depth_sensor", "Sensor depth"},
                                                  {"instance", "Objects"},
                                                  {"semantic", "Classes"}}};
// Image sizes in order of preference; the first has the width of images on the page.
constexpr std::array<SmallPictureSize, 7> kSizes = {
    {{512, 82}, {448, 82}, {384, 80}, {320, 80}, {256, 78}, {208, 75}, {160, 72}}};
constexpr std::size_t kTried = 12;       // number of frames for estimating sizes
constexpr double kSafety = 1.06;         // factor on the estimate
constexpr std::size_t kJsonPerFile = 3;  // quotes and comma, also for missing images

std::string fileOf(const GuardedFolder& folder, const std::string& modality, int frame) {
    std::string name = verify::imageFile(modality, frame);
    if (modality != "rgb_sensor" || folder.has(name)) return name;
    return name.substr(0, name.size() - 4) + ".jpg";
}

/// Encodes images of a dataset.
class PictureMaker {
  public:
    PictureMaker(const verify::StoredDataset& dataset, const GuardedFolder& folder)
        : dataset_(dataset), folder_(folder) {
        for (const ShownModality& one : kShown) {
            if (dataset.has(one.name)) kinds_.push_back({one.name, one.text, {}});
        }
    }

    [[nodiscard]] const std::vector<PictureKind>& kinds() const { return kinds_; }

    /// Size of these frames' images in the page, bytes.
    [[nodiscard]] std::size_t bytesOf(const std::vector<int>& frames, const SmallPictureSize& size,
                                      const JobContext& job) const {
        return bytesIn(make(frames, size, job));
    }

    [[nodiscard]] static std::size_t bytesIn(const std::vector<PictureKind>& kinds) {
        std::size_t bytes = 0;
        for (const PictureKind& kind : kinds) {
            for (const auto& file : kind.files) bytes += base64Length(file.size());
        }
        return bytes;
    }

    /// Incomplete once the job is cancelled.
    [[nodiscard]] std::vector<PictureKind> make(const std::vector<int>& frames,
                                                const SmallPictureSize& size,
                                                const JobContext& job) const {
        SmallPictureSize fitting = size;
        fitting.width_px = std::min(size.width_px, dataset_.lens.width);
        std::vector<PictureKind> made = kinds_;
        for (PictureKind& kind : made) kind.files.resize(dataset_.frames.size());
        parallelFor(frames.size() * made.size(), [&](std::size_t i) {
            if (job.cancelled()) return;
            PictureKind& kind = made[i % made.size()];
            const int frame = frames[i / made.size()];
            kind.files[frame] =
                render::encodeSmallPicture(folder_, fileOf(folder_, kind.modality, frame),
                                           kind.modality, dataset_.classes(), fitting);
        });
        return made;
    }

  private:
    const verify::StoredDataset& dataset_;
    const GuardedFolder& folder_;
    std::vector<PictureKind> kinds_;
};

/// `count` frames: as many of `first` as fit, then evenly spaced ones.
std::vector<int> choose(const std::vector<int>& first, std::size_t count, std::size_t frames) {
    std::vector<bool> taken(frames, false);
    for (const int at : evenlySpaced(count, first.size())) {
        taken[first[at]] = true;
    }
    std::vector<int> others;
    for (std::size_t i = 0; i < frames; ++i) {
        if (!taken[i]) others.push_back(static_cast<int>(i));
    }
    for (const int at : evenlySpaced(count - std::min(count, first.size()), others.size())) {
        taken[others[at]] = true;
    }
    std::vector<int> chosen;
    for (std::size_t i = 0; i < frames; ++i) {
        if (taken[i]) chosen.push_back(static_cast<int>(i));
    }
    return chosen;
}

/// Image size and number of frames to try.
struct PictureTry {
    std::size_t size = 0;  // index into kSizes
    std::size_t frames = 0;
};

/// The largest size at which all frames should fit, otherwise the smallest size with fewer frames;
/// estimated from a few frames.
PictureTry firstTry(const PictureMaker& maker, std::size_t frames, std::size_t most_bytes,
                    const JobContext& job) {
    const std::vector<int> tried = evenlySpaced(kTried, frames);
    double per_frame = 0.0;
    for (std::size_t size = 0; size < kSizes.size(); ++size) {
        per_frame = kSafety * static_cast<double>(maker.bytesOf(tried, kSizes[size], job)) /
                    static_cast<double>(tried.size());
        if (per_frame * static_cast<double>(frames) <= static_cast<double>(most_bytes)) {
            return {size, frames};
        }
    }
    return {kSizes.size() - 1,
            std::min(frames, static_cast<std::size_t>(static_cast<double>(most_bytes) /
                                                      std::max(per_frame, 1.0)))};
}

/// The next smaller size or fewer frames, if the images are larger than estimated.
PictureTry nextTry(PictureTry before) {
    if (before.size + 1 < kSizes.size()) return {before.size + 1, before.frames};
    return {before.size, before.frames * 9 / 10};
}

int unreadableIn(const FramePictures& pictures) {
    int count = 0;
    for (const PictureKind& kind : pictures.kinds) {
        for (std::size_t i = 0; i < pictures.chosen.size(); ++i) {
            count += pictures.chosen[i] && kind.files[i].empty() ? 1 : 0;
        }
    }
    return count;
}

}  // namespace

Result<FramePictures> makeFramePictures(const verify::StoredDataset& dataset,
                                        const std::vector<int>& first, std::size_t most_bytes,
                                        const JobContext& job) {
    const Result<GuardedFolder> folder = GuardedFolder::open(dataset.folder);
    if (!folder) return fail(ErrorCode::BadInput, folder.error().message, folder.error().where);
    const PictureMaker maker(dataset, *folder);
    const std::size_t frames = dataset.frames.size();
    FramePictures pictures;
    pictures.chosen.assign(frames, false);
    if (maker.kinds().empty() || frames == 0) return pictures;
    const std::size_t always = kJsonPerFile * frames * maker.kinds().size();
    const std::size_t most = most_bytes - std::min(always, most_bytes);
    PictureTry now = firstTry(maker, frames, most, job);
    while (true) {
        job.report(0.3);
        const std::vector<int> chosen = choose(first, now.frames, frames);
        pictures.size = kSizes[now.size];
        pictures.kinds = maker.make(chosen, pictures.size, job);
        if (job.cancelled())
            return fail(ErrorCode::Cancelled,
                        "The page was not made because the job was cancelled.");
        if (now.frames == 0 || PictureMaker::bytesIn(pictures.kinds) <= most) {
            for (const int frame : chosen) pictures.chosen[frame] = true;
            break;
        }
        now = nextTry(now);
    }
    pictures.unreadable = unreadableIn(pictures);
    return pictures;
}

}  // namespace dollytrack::view
