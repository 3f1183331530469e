#include "render/verify/read/track_files.h"

#include "render/verify/read/numpy_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dollytrack::verify {
namespace {

constexpr std::array kTrackArrays = {"points", "points_3d", "occluded", "query_points",
                                     "object_ids"};

/// Reads one array into `into`; returns the problem, naming the file, or nothing.
template <class Read, class Values>
Status take(const StoredDataset& dataset, const std::string& name, Read&& read, int rows,
            int columns, Values& into) {
    auto array = read(dataset.folder / name);
    if (!array) return fail(ErrorCode::BadInput, array.error().message, name);
    if ((rows >= 0 && array->height != rows) || (columns >= 0 && array->width != columns)) {
        const auto side = [](int size) { return size < 0 ? "any" : fmt::format("{}", size); };
        return fail(ErrorCode::BadInput,
                    fmt::format("it has {} rows and {} columns, the clip needs {} and {}",
                                array->height, array->width, side(rows), side(columns)),
                    name);
    }
    into = std::move(*array);
    return {};
}

}  // namespace

std::string trackFile(int first_frame, const char* array) {
    return fmt::format("tracks/{:06}_{}.npy", first_frame, array);
}

int clipFrames(const StoredDataset& dataset) {
    const auto convention = dataset.convention("tracks");
    if (!convention.is_object() || !convention.contains("clip_frames")) return 0;
    const auto& count = convention["clip_frames"];
    if (!count.is_number_integer()) return 0;
    const auto frames = count.get<std::int64_t>();
    return frames >= 1 && frames <= 1'000'000 ? static_cast<int>(frames) : 0;
}

std::vector<std::string> trackFiles(const StoredDataset& dataset, int frame) {
    std::vector<std::string> names;
    if (!dataset.has("tracks")) return names;
    const int clip = clipFrames(dataset);
    if (clip == 0 || frame % clip != 0) return names;
    for (const char* const array : kTrackArrays) names.push_back(trackFile(frame, array));
    return names;
}

Result<StoredTracks> readTracks(const StoredDataset& dataset, int first_frame) {
    const int frames =
        std::min(clipFrames(dataset), static_cast<int>(dataset.frames.size()) - first_frame);
    StoredTracks tracks;
    const auto file = [&](const char* array) { return trackFile(first_frame, array); };
    const auto floats = [](int channels) {
        return [channels](const auto& path) { return readNumpyF(path, channels); };
    };
    Status status = take(dataset, file("points"), floats(2), -1, frames, tracks.points);
    const int count = tracks.count();
    if (status) {
        status = take(dataset, file("points_3d"), floats(3), count, frames, tracks.places);
    }
    if (status) {
        status = take(dataset, file("occluded"), readNumpyBool, count, frames, tracks.occluded);
    }
    if (status) {
        status = take(dataset, file("query_points"), floats(1), count, 3, tracks.queries);
    }
    if (status) {
        const auto ids = [](const auto& path) { return readNumpy16(path, 1); };
        status = take(dataset, file("object_ids"), ids, 1, count, tracks.object_ids);
    }
    if (!status) return tl::unexpected(status.error());
    return tracks;
}

}  // namespace dollytrack::verify
