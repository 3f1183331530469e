#include "render/formats/media/video.h"

#include "engine/io/files/guarded_folder.h"
#include "render/formats/media/video_encoder.h"
#include "render/pictures/picture_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 1> kVideoFiles = {"preview.mp4"};

/// Mean number of images per second, so that the video lasts as long as the trajectory. A single
/// frame uses the trajectory's rate.
double rateOf(const DatasetContents& contents) {
    const std::vector<DatasetFrame>& frames = contents.frames;
    if (frames.size() < 2)
        return std::clamp(1.0 / contents.frame_interval_s, kSlowestVideo, kFastestVideo);
    const double seconds = frames.back().camera.time_s - frames.front().camera.time_s;
    const auto steps = static_cast<double>(frames.size() - 1);
    return seconds > 0.0 ? std::clamp(steps / seconds, kSlowestVideo, kFastestVideo)
                         : kFastestVideo;
}

Result<cv::Mat> readPicture(const GuardedFolder& folder, const std::string& file) {
    cv::Mat picture = readPictureFile(folder, file);
    if (picture.type() != CV_8UC3) {
        return fail(
            ErrorCode::CannotWrite,
            "this image, written before, cannot be read again for the video; check the disk and "
            "export again",
            (folder.path() / file).string());
    }
    return picture;
}

Result<std::vector<DatasetFile>> writeVideo(const DatasetContents& contents) {
    Result<VideoEncoder> video =
        VideoEncoder::begin(contents.camera.width_px, contents.camera.height_px, rateOf(contents));
    if (!video) return tl::unexpected(video.error());
    const Result<GuardedFolder> folder = GuardedFolder::open(contents.folder);
    if (!folder) return tl::unexpected(folder.error());
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const Result<cv::Mat> picture = readPicture(*folder, frameFile("rgb", static_cast<int>(i)));
        if (!picture) return tl::unexpected(picture.error());
        const Status status = video->add({picture->data, picture->total() * picture->elemSize()});
        if (!status) return tl::unexpected(status.error());
    }
    Result<std::string> file = video->finish();
    if (!file) return tl::unexpected(file.error());
    return std::vector<DatasetFile>{{kVideoFiles[0], std::move(*file)}};
}

nlohmann::ordered_json videoConvention(const DatasetContents& /*contents*/) {
    return {{"file", kVideoFiles[0]},
            {"format",
             "MP4, H.264: preview of the trajectory with every frame of rgb once, each for the "
             "same duration, at the trajectory's mean frame rate; lossy, not meant as data"}};
}

}  // namespace

const Format kVideoFormat = {
    .name = "video",
    .text = "the images as a video, in preview.mp4",
    .group = ContentGroup::Other,
    .files = kVideoFiles,
    .write = writeVideo,
    .convention = videoConvention,
    .modality = "rgb",
    .bytes_per_pixel = 0.15,
    .missing = missingVideoLibrary,
};

}  // namespace dollytrack::render
