// Compares tracked points with the poses, depth and ids of the frames and the motions of objects.
#include "render/verify/check/check_list.h"
#include "render/verify/compare/frame_rays.h"
#include "render/verify/compare/other_view.h"
#include "render/verify/read/track_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>

namespace dollytrack::verify {
namespace {

/// The clips of a dataset, of which the last three by frame number are kept. Thread-safe.
class Clips {
  public:
    explicit Clips(const StoredDataset& dataset) : dataset_(dataset) {}

    /// Null if the clip cannot be read, which is reported once while it is kept.
    std::shared_ptr<const StoredTracks> at(int first_frame, Findings& findings) {
        const std::lock_guard lock(mutex_);
        if (const auto found = clips_.find(first_frame); found != clips_.end()) {
            return found->second;
        }
        constexpr std::size_t kKept = 3;
        if (clips_.size() >= kKept) clips_.erase(clips_.begin());
        Result<StoredTracks> tracks = readTracks(dataset_, first_frame);
        auto& kept = clips_[first_frame];
        if (tracks) {
            kept = std::make_shared<const StoredTracks>(std::move(*tracks));
        } else {
            const Error& error = tracks.error();
            findings.add({error.where, first_frame, {}, error.message, "the arrays of a clip"});
        }
        return kept;
    }

  private:
    const StoredDataset& dataset_;
    std::mutex mutex_;
    std::map<int, std::shared_ptr<const StoredTracks>> clips_;  // by first frame
};

const char* expectedOfTrack(WrongVisibility::Expected expected) {
    switch (expected) {
        case WrongVisibility::Expected::Seen:
            return "visible";
        case WrongVisibility::Expected::Occluded:
            return "occluded, a surface is in front";
        case WrongVisibility::Expected::Inside:
            return "a position inside the image";
        default:
            return "occluded, because it is outside the image";
    }
}

/// The tracks of a clip in one of its frames.
class TracksInFrame {
  public:
    TracksInFrame(const Subject& subject, const StoredTracks& tracks, int first_frame,
                  FrameImages& images)
        : subject_(subject),
          dataset_(subject.dataset),
          tracks_(tracks),
          first_frame_(first_frame),
          column_(images.frame() - first_frame),
          images_(images),
          view_{images.stored().pose, images.stored()} {}

    void check(Findings& findings) {
        std::vector<ReprojectedPixel> projected;
        for (int i = 0; i < tracks_.count(); ++i) projected.push_back(project(i));
        std::vector<std::uint8_t> visibilities;
        Findings unlikely;
        for (int i = 0; i < tracks_.count(); ++i) {
            checkPoint(i, projected[i], findings);
            checkPlace(i, findings);
            checkObject(i, projected[i], subject_.rays ? findings : unlikely);
            // The depth image shows the point at its query for certain.
            const bool is_query = tracks_.queries.at(0, i) == static_cast<float>(column_);
            if (!subject_.rays) checkDepth(i, projected[i], is_query ? findings : unlikely);
            visibilities.push_back(visibilityOf(i, projected[i]));
        }
        // A point may be visible through a slit narrower than a pixel, or on an object thinner than
        // one, without showing up in the depth; many points may not.
        if (unlikely.count > 5 + visibilities.size() / 100) findings.append(unlikely);
        for (const WrongVisibility& wrong :
             wrongVisibilities(subject_, visibilities, projected, 0.0, view_)) {
            add(static_cast<int>(wrong.point), "occluded",
                visibilities[wrong.point] == kSeen ? "visible" : "occluded",
                expectedOfTrack(wrong.expected), findings);
        }
    }

  private:
    void add(int track, const char* array, std::string found, std::string expected,
             Findings& findings) const {
        findings.add({trackFile(first_frame_, array),
                      images_.frame(),
                      {},
                      fmt::format("track {}: {}", track, found),
                      std::move(expected)});
    }

    [[nodiscard]] Eigen::Vector3d place(int track, int column) const {
        return Eigen::Map<const Eigen::Vector3f>(tracks_.places.pixel(column, track))
            .cast<double>();
    }

    [[nodiscard]] ReprojectedPixel project(int track) const {
        ReprojectedPixel pixel;
        pixel.place = place(track, column_);
        const Eigen::Vector3d there = view_.camera.toCamera(pixel.place);
        pixel.depth_m = there.z();
        // Single precision of the position.
        const double off_m = 1e-6 * (1.0 + pixel.place.norm());
        pixel.behind = !(there.z() >= dataset_.near_m);
        pixel.may_be_behind = there.z() < dataset_.near_m + off_m;
        if (pixel.behind) return pixel;
        pixel.at = dataset_.lens.project(there);
        // Near the camera's plane, an error in depth moves the point far.
        pixel.off_px =
            off_m * dataset_.lens.fx / there.z() * (1.0 + there.head<2>().norm() / there.z());
        return pixel;
    }

    [[nodiscard]] Eigen::Vector2d point(int track) const {
        return Eigen::Map<const Eigen::Vector2f>(tracks_.points.pixel(column_, track))
            .cast<double>();
    }

    [[nodiscard]] bool isInside(const Eigen::Vector2d& at) const {
        return at.x() >= 0.0 && at.y() >= 0.0 && at.x() < dataset_.lens.width &&
               at.y() < dataset_.lens.height;
    }

    [[nodiscard]] std::uint8_t visibilityOf(int track, const ReprojectedPixel& projected) const {
        if (tracks_.occluded.at(column_, track) == 0) return kSeen;
        return projected.behind || !isInside(point(track)) ? kOutside : kOccluded;
    }

    /// The image position is that of the position in the world.
    void checkPoint(int track, const ReprojectedPixel& projected, Findings& findings) const {
        const Eigen::Vector2d found = point(track);
        const bool is_marked = found == Eigen::Vector2d(-1.0, -1.0);
        if (projected.may_be_behind && (projected.behind || is_marked)) {
            if (is_marked || !projected.behind) return;
            add(track, "points", fmt::format("({:.3f}, {:.3f}) px", found.x(), found.y()),
                "(-1, -1), nearer than near_m", findings);
            return;
        }
        const double allowed = 0.01 + projected.off_px + 1e-6 * projected.at.norm();
        if ((found - projected.at).norm() <= allowed) return;
        add(track, "points", fmt::format("({:.3f}, {:.3f}) px", found.x(), found.y()),
            fmt::format("({:.3f}, {:.3f}) px, by points_3d and the pose", projected.at.x(),
                        projected.at.y()),
            findings);
    }

    /// The point moves with its object from where it was chosen, on that object's surface.
    void checkPlace(int track, Findings& findings) {
        const float* query = tracks_.queries.pixel(0, track);
        const float chosen_in = query[0];
        const int frames = tracks_.points.width;
        const bool is_frame = chosen_in >= 0.0F && chosen_in < static_cast<float>(frames) &&
                              chosen_in == std::floor(chosen_in);
        const Eigen::Vector2d chosen_at(query[2], query[1]);
        if (!is_frame || !isInside(chosen_at)) {
            if (column_ == 0) {
                add(track, "query_points",
                    fmt::format("({}, {}, {})", query[0], query[1], query[2]),
                    "a frame of the clip, and y and x inside the image", findings);
            }
            return;
        }
        const int query_column = static_cast<int>(chosen_in);
        const int id = tracks_.object_ids.at(track, 0);
        const Eigen::Vector3d moved =
            view_.motion(dataset_.frames[first_frame_ + query_column], id) *
            place(track, query_column);
        const Eigen::Vector3d found = place(track, column_);
        if (!((found - moved).norm() <= 1e-5 * (1.0 + moved.norm()))) {
            add(track, "points_3d",
                fmt::format("({:.4f}, {:.4f}, {:.4f}) m", found.x(), found.y(), found.z()),
                fmt::format("({:.4f}, {:.4f}, {:.4f}) m, by the motion of object {}", moved.x(),
                            moved.y(), moved.z(), id),
                findings);
        }
        if (query_column != column_) return;
        const Eigen::Vector2d at = point(track);
        const bool is_hidden = tracks_.occluded.at(column_, track) != 0;
        if (!((at - chosen_at).norm() <= 0.01) || is_hidden) {
            add(track, "query_points",
                fmt::format("{} at ({:.3f}, {:.3f}) px", is_hidden ? "occluded" : "visible", at.x(),
                            at.y()),
                fmt::format("visible at ({:.3f}, {:.3f}) px", chosen_at.x(), chosen_at.y()),
                findings);
        }
    }

    /// The pixel in which the point was chosen shows the point's object, at the point's depth.
    void checkObject(int track, const ReprojectedPixel& projected, Findings& findings) {
        const float* query = tracks_.queries.pixel(0, track);
        const Eigen::Vector2d at(query[2], query[1]);
        if (query[0] != static_cast<float>(column_) || !isInside(at)) return;
        const int id = tracks_.object_ids.at(track, 0);
        if (dataset_.object(id) == nullptr) {
            add(track, "object_ids", fmt::format("object {}", id), "an object of dataset.json",
                findings);
            return;
        }
        const int x = static_cast<int>(at.x());
        const int y = static_cast<int>(at.y());
        if (subject_.rays) {
            if (projected.depth_m > FrameRays::kFarthest) return;
            if (!rays_)
                rays_ = std::make_unique<FrameRays>(subject_, images_.stored(), view_.camera);
            if (rays_->mayShow(x, y, id, projected.depth_m, 1e-5)) return;
            add(track, "points_3d", fmt::format("object {} at {:.4f} m", id, projected.depth_m),
                fmt::format("the surface in pixel ({}, {})", x, y), findings);
            return;
        }
        const Image16* ids = images_.image16("instance");
        if (!ids) return;
        // Rasterisation may decide differently at edges.
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (ids->holds(x + dx, y + dy) && ids->at(x + dx, y + dy) == id) return;
            }
        }
        add(track, "object_ids", fmt::format("object {}", id),
            fmt::format("object {}, by the instance image", ids->at(x, y)), findings);
    }

    /// A visible point lies between the nearest and the farthest surface of the pixels around it; a
    /// hidden one is not in front of all of them.
    void checkDepth(int track, const ReprojectedPixel& projected, Findings& findings) {
        const FrameImages::Depth* depth = images_.depth();
        if (!depth || projected.behind || !isInside(projected.at)) return;
        const int x = static_cast<int>(projected.at.x());
        const int y = static_cast<int>(projected.at.y());
        double nearest = std::numeric_limits<double>::infinity();
        double farthest = 0.0;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (!depth->metres.holds(x + dx, y + dy)) continue;
                const double metres = depth->metres.at(x + dx, y + dy);
                if (!(metres > 0.0)) return;
                nearest = std::min(nearest, metres);
                farthest = std::max(farthest, metres);
            }
        }
        // Surfaces go on for a pixel beyond the centres, and may bend there.
        const double slack =
            0.003 + 2.0 * depth->rounding_m + 0.003 * projected.depth_m + (farthest - nearest);
        const bool is_seen = tracks_.occluded.at(column_, track) == 0;
        const bool in_front = projected.depth_m < nearest - slack;
        const bool behind = projected.depth_m > farthest + slack;
        if (!in_front && !(is_seen && behind)) return;
        add(track, is_seen ? "occluded" : "points_3d",
            fmt::format("a {} point {:.4f} m from the camera", is_seen ? "visible" : "hidden",
                        projected.depth_m),
            fmt::format("surfaces at {:.4f} to {:.4f} m, by the depth image", nearest, farthest),
            findings);
    }

    const Subject& subject_;
    const StoredDataset& dataset_;
    const StoredTracks& tracks_;
    int first_frame_ = 0;
    int column_ = 0;
    FrameImages& images_;
    OtherView view_;
    std::unique_ptr<FrameRays> rays_;  // of the frame; made when needed
};

}  // namespace

CheckWork beginTracks(const Subject& subject, Findings& findings) {
    const int clip = clipFrames(subject.dataset);
    CheckWork work;
    if (clip == 0) {
        findings.add({"dataset.json",
                      {},
                      {},
                      "conventions.tracks has no clip_frames",
                      "a number of frames"});
        return work;
    }
    work.frame = [&subject, clip, clips = std::make_shared<Clips>(subject.dataset)](
                     FrameImages& images, Findings& found) {
        const int first = images.frame() / clip * clip;
        if (const auto tracks = clips->at(first, found)) {
            TracksInFrame(subject, *tracks, first, images).check(found);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
