#include "render/encoders/encoders.h"
#include "render/encoders/numpy_file.h"
#include "render/truth/point_tracks.h"

#include <nlohmann/json.hpp>

#include <bit>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays' types are little-endian");

/// Also for Eigen's vectors, which are numbers in a row.
template <class Value>
std::span<const std::uint8_t> numbersOf(const std::vector<Value>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), sizeof(Value) * values.size()};
}

}  // namespace

FrameFiles encodeTracks(const FrameContext& context, const FrameRecord& frame) {
    std::vector<FrameFile> files;
    if (frame.index % kClipFrames != 0) return files;
    const PointTracks tracks = trackPoints(context, frame.index);
    std::vector<Eigen::Vector3f> queries;
    for (const Eigen::Vector3i& query : tracks.queries) {
        const Eigen::Vector3f at = query.cast<float>();
        queries.emplace_back(at[0], at[2] + 0.5F, at[1] + 0.5F);
    }
    const int count = static_cast<int>(tracks.queries.size());
    const auto add = [&](const char* name, std::string_view type, const std::vector<int>& shape,
                         std::span<const std::uint8_t> values) {
        files.push_back({frameFile("tracks", frame.index, std::string("_") + name + ".npy"),
                         numpyBytes(type, shape, values)});
    };
    add("points", "<f4", {count, tracks.frames, 2}, numbersOf(tracks.points));
    add("points_3d", "<f4", {count, tracks.frames, 3}, numbersOf(tracks.positions));
    add("occluded", "|b1", {count, tracks.frames}, numbersOf(tracks.occluded));
    add("query_points", "<f4", {count, 3}, numbersOf(queries));
    add("object_ids", "<u2", {count}, numbersOf(tracks.object_ids));
    return files;
}

nlohmann::ordered_json tracksConvention(const DatasetContents&) {
    return {{"folder", "tracks"},
            {"files",
             {{"AAAAAA_points.npy",
               "float32, (tracks, frames, 2): x and y in px; the centre of the "
               "first pixel is at (0.5, 0.5); (-1, -1) nearer than near_m"},
              {"AAAAAA_points_3d.npy", "float32, (tracks, frames, 3): position in the world, m"},
              {"AAAAAA_occluded.npy",
               "bool, (tracks, frames): hidden by a surface, or outside the image"},
              {"AAAAAA_query_points.npy",
               "float32, (tracks, 3): frame counted from A, y, x, where "
               "the point was chosen and is visible"},
              {"AAAAAA_object_ids.npy", "uint16, (tracks)"}}},
            {"clip_frames", kClipFrames},
            {"meaning",
             "points on surfaces, followed from frame A for clip_frames frames or to the last; "
             "chosen at random in every frame of the clip, and moving with their objects"}};
}

}  // namespace dollytrack::render
