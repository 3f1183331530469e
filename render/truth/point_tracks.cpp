#include "render/truth/point_tracks.h"

#include "engine/camera/intrinsics.h"
#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "render/truth/visibility_mask.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace dollytrack::render {
namespace {

constexpr int kMostTracks = 10'000;
constexpr int kPixelsPerTrack = 30;

/// A point on an object, in the scene's own positions.
struct TrackedPoint {
    Eigen::Vector3i query = Eigen::Vector3i::Zero();  // frame of the clip, column, row
    int object_id = 0;
    Eigen::Vector3d at_rest = Eigen::Vector3d::Zero();
};

/// A point visible in a frame, or none if no surface was found. `clip_frame` is `frame` counted
/// from the clip's first.
std::optional<TrackedPoint> choosePoint(const FrameContext& context, const RayCaster& rays,
                                        int frame, int clip_frame, Random& random) {
    const DatasetContents& contents = context.contents;
    const Intrinsics lens = makeIntrinsics(contents.camera);
    const Pose& pose = contents.frames[frame].camera.pose;
    std::vector<RayHit> hits;
    constexpr int kTries = 20;
    for (int i = 0; i < kTries; ++i) {
        const auto x = static_cast<int>(random.below(static_cast<std::uint32_t>(lens.width)));
        const auto y = static_cast<int>(random.below(static_cast<std::uint32_t>(lens.height)));
        const Eigen::Vector3d along = pose.rotation * lens.unproject(x + 0.5, y + 0.5);
        // A ray beside it, because rays can pass between two triangles that should touch.
        const Eigen::Vector3d beside = pose.rotation * lens.unproject(x + 0.75, y + 0.75);
        const std::array<RayCaster::BundleRay, 2> bundle = {{{along}, {beside}}};
        rays.castBundle(pose.position, bundle, contents.camera.near_m, hits);
        const int id = hits[0].object_id;
        if (id == 0 || hits[1].object_id != id) continue;
        const Eigen::Vector3d place = pose.position + hits[0].distance * along;
        const Eigen::Isometry3d motion = motionOf(contents.motions, id, frame);
        return TrackedPoint{{clip_frame, x, y}, id, motion.inverse() * place};
    }
    return std::nullopt;
}

std::vector<TrackedPoint> choosePoints(const FrameContext& context, int first_frame, int frames) {
    const CameraParams& camera = context.contents.camera;
    const int wanted = std::min(kMostTracks, camera.width_px * camera.height_px / kPixelsPerTrack);
    std::vector<std::optional<TrackedPoint>> found(wanted);
    const auto firstOf = [&](int frame) {
        return static_cast<int>(std::int64_t{wanted} * frame / frames);
    };
    // One frame after the other: raysAt() may build a ray caster, which is parallel itself.
    for (int i = 0; i < frames; ++i) {
        const int frame = first_frame + i;
        const std::shared_ptr<const RayCaster> rays = context.moving.raysAt(frame);
        Random random(static_cast<std::uint64_t>(context.contents.sourceFrame(frame)));
        for (int k = firstOf(i); k < firstOf(i + 1); ++k) {
            found[k] = choosePoint(context, *rays, frame, i, random);
        }
    }
    std::vector<TrackedPoint> points;
    for (const auto& point : found) {
        if (point) points.push_back(*point);
    }
    return points;
}

}  // namespace

PointTracks trackPoints(const FrameContext& context, int first_frame) {
    const DatasetContents& contents = context.contents;
    const Intrinsics lens = makeIntrinsics(contents.camera);
    const double near_m = contents.camera.near_m;
    PointTracks tracks;
    tracks.frames = std::min(kClipFrames, static_cast<int>(contents.frames.size()) - first_frame);
    const std::vector<TrackedPoint> chosen = choosePoints(context, first_frame, tracks.frames);
    for (const TrackedPoint& point : chosen) {
        tracks.queries.push_back(point.query);
        tracks.object_ids.push_back(static_cast<std::uint16_t>(point.object_id));
    }
    const std::size_t frames = static_cast<std::size_t>(tracks.frames);
    tracks.points.assign(chosen.size() * frames, Eigen::Vector2f::Constant(-1.0F));
    tracks.positions.resize(chosen.size() * frames);
    tracks.occluded.resize(chosen.size() * frames);
    constexpr std::size_t kGrain = 500;
    for (std::size_t t = 0; t < frames; ++t) {
        const int frame = first_frame + static_cast<int>(t);
        const Pose& pose = contents.frames[frame].camera.pose;
        const std::shared_ptr<const RayCaster> rays = context.moving.raysAt(frame);
        parallelRanges(chosen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            std::vector<Eigen::Vector3d> positions;
            for (std::size_t i = begin; i < end; ++i) {
                positions.push_back(motionOf(contents.motions, chosen[i].object_id, frame) *
                                    chosen[i].at_rest);
            }
            const std::vector<PixelVisibility> seen = visibilityFrom(
                *rays, pose, lens, near_m, positions, std::vector<bool>(positions.size(), false));
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t at = i * frames + t;
                tracks.positions[at] = positions[i - begin].cast<float>();
                tracks.occluded[at] = seen[i - begin] == PixelVisibility::Seen ? 0 : 1;
                const Eigen::Vector3d there = pose.toCamera(positions[i - begin]);
                if (there.z() >= near_m) tracks.points[at] = lens.project(there).cast<float>();
            }
        });
    }
    return tracks;
}

}  // namespace dollytrack::render
