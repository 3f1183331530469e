#include "planning/timing/heading_keys.h"

#include "engine/math/angle.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kSameView = 0.05 * kDegree;  // a smaller turn is not worth a frame
constexpr double kSameLine = 0.5 * kDegree;   // smoothing does not round corners below this angle
                                              // alone
constexpr double kSamePlace_m = 1e-9;
constexpr double kLooksAhead_m = 2.0;

/// Unit direction of motion at a parameter of a piece.
Eigen::Vector3d motionAt(const SmoothPath::Piece& piece, double t) {
    if (!piece.curved) return (piece.end - piece.start).normalized();
    return ((1.0 - t) * (piece.control - piece.start) + t * (piece.end - piece.control))
        .normalized();
}

class KeyMaker {
  public:
    KeyMaker(const SmoothPath& path, const std::function<Pose(const SmoothPath::Key&)>& pose_at,
             const HeadingLimit& limit)
        : path_(path), pose_at_(pose_at), limit_(limit) {}

    std::vector<SmoothPath::Key> make() {
        const std::vector<SmoothPath::Key>& keys = path_.keys;
        std::size_t next = 0;
        for (std::size_t p = 0; p < path_.pieces.size(); ++p) {
            const SmoothPath::Piece& piece = path_.pieces[p];
            const double end_m = piece.begin_m + piece.length_m;
            while (next < keys.size() && keys[next].arc_m <= piece.begin_m + kSamePlace_m) {
                keep(keys[next++]);
            }
            lookAlong(piece.begin_m, piece.start, motionAt(piece, 0.0));
            for (; next < keys.size() && keys[next].arc_m < end_m - kSamePlace_m; ++next) {
                pass(keys[next], piece);
            }
            lookAlong(end_m, piece.end, motionAt(piece, 1.0));
        }
        while (next < keys.size()) keep(keys[next++]);
        return std::move(made_);
    }

  private:
    /// Adds a key inside a piece: in passing if its view is allowed, else with turns on the spot.
    void pass(const SmoothPath::Key& key, const SmoothPath::Piece& piece) {
        const Eigen::Vector3d view = pose_at_(key).forward();
        const double t = piece.parameterAt(key.arc_m - piece.begin_m);
        const bool passes = std::ranges::all_of(std::array{0.0, t, 1.0}, [&](double at) {
            return limit_.allows(view, motionAt(piece, at));
        });
        if (passes) return keep(key);
        lookAlong(key.arc_m, key.position, motionAt(piece, t));
        keep(key);
        lookAlong(key.arc_m, key.position, motionAt(piece, t));
    }

    void keep(const SmoothPath::Key& key) {
        made_.push_back(key);
        view_ = pose_at_(key).forward();
    }

    void lookAlong(double arc_m, const Eigen::Vector3d& position, const Eigen::Vector3d& motion) {
        if (isUpright(motion)) return;
        const Eigen::Vector3d ahead(motion.x(), motion.y(), 0.0);
        const bool is_here = !made_.empty() && made_.back().arc_m >= arc_m - kSamePlace_m;
        // Small changes of direction need no stop.
        const double same = is_here && made_.back().position_point < 0 ? kSameLine : kSameView;
        if (is_here && angleFromAbove(view_, ahead) <= same && !isUpright(view_)) return;
        SmoothPath::Key key;
        key.arc_m = arc_m;
        key.position = position;
        key.looks_at = position + kLooksAhead_m * ahead.normalized();
        keep(key);
    }

    const SmoothPath& path_;
    const std::function<Pose(const SmoothPath::Key&)>& pose_at_;
    HeadingLimit limit_;
    std::vector<SmoothPath::Key> made_;
    Eigen::Vector3d view_ = Eigen::Vector3d::UnitZ();  // of the last key
};

}  // namespace

SmoothPath withHeadingKeys(const SmoothPath& path,
                           const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                           const HeadingLimit& limit) {
    if (!limit.restricts()) return path;
    SmoothPath made = path;
    made.keys = KeyMaker(path, pose_at, limit).make();
    return made;
}

}  // namespace dollytrack::planning
