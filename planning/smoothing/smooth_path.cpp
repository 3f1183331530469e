#include "planning/smoothing/smooth_path.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/candidate_evaluator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kShrink = 0.6;
constexpr int kHalvings = 4;            // bisection steps between a free set-back and a refused one
constexpr double kLeastSetBack = 0.02;  // m; a smaller curve is no smoother than a stop
constexpr double kReversal = 150.0 * std::numbers::pi / 180.0;
constexpr double kStraight = 0.5 * std::numbers::pi / 180.0;
constexpr int kFineCurveGrid = 16;
constexpr int kCoarseCurveGrid = 10;
// With this many rays on the object and nearly all unoccluded, a coarse estimate is enough.
constexpr int kEnoughRays = 30;
constexpr double kNearlyWhole = 0.96;  // visible fraction
constexpr double kFarEnough = 1.0;     // m; cap of the reported clearance

struct Curve {
    Eigen::Vector3d start, corner, end;
    [[nodiscard]] Eigen::Vector3d middle() const {
        return 0.25 * start + 0.5 * corner + 0.25 * end;
    }
};

class Smoother {
  public:
    Smoother(const CameraPath& path, const std::vector<PositionPoint>& points,
             const std::vector<ObservationPoint>& targets, const PlanningEnvironment& environment,
             double set_back)
        : path_(path),
          points_(points),
          targets_(targets),
          environment_(environment),
          set_back_(set_back) {}

    [[nodiscard]] Corner roundCorner(std::size_t i) const {
        Corner corner;
        corner.vertex = static_cast<int>(i);
        // The path passes through fixed points exactly.
        if (isFixed(i)) {
            corner.shortened = true;
            return corner;
        }
        const Eigen::Vector3d in = at(i) - at(i - 1);
        const Eigen::Vector3d out = at(i + 1) - at(i);
        if (in.norm() < 1e-6 || out.norm() < 1e-6) return corner;
        const double turn = angleBetween(in, out);
        if (turn < kStraight) return corner;
        double wish = std::min({set_back_, 0.5 * in.norm(), 0.5 * out.norm()});
        corner.shortened = wish < set_back_;
        if (turn > kReversal) return corner;
        if (turnsOnTheSpot(i, in, out)) {
            corner.shortened = true;
            return corner;
        }
        wish = furthest(i, wish);
        // Fine sampling decides the final set-back only.
        while (wish >= kLeastSetBack && !keepsCaptures(i, wish, Sampling::Fine)) {
            wish = furthest(i, kShrink * wish);
        }
        if (wish < set_back_) corner.shortened = true;
        if (wish < kLeastSetBack) return corner;
        corner.set_back_m = wish;
        return corner;
    }

    /// The paper's rounding: tests neither obstacles nor captures.
    [[nodiscard]] Corner roundBlindly(std::size_t i) const {
        const Eigen::Vector3d in = at(i) - at(i - 1);
        const Eigen::Vector3d out = at(i + 1) - at(i);
        Corner corner;
        corner.vertex = static_cast<int>(i);
        if (in.norm() < 1e-6 || out.norm() < 1e-6 || angleBetween(in, out) < kStraight) {
            return corner;
        }
        corner.set_back_m = std::min({set_back_, 0.5 * in.norm(), 0.5 * out.norm()});
        corner.shortened = corner.set_back_m < set_back_;
        return corner;
    }

    [[nodiscard]] SmoothPath assemble(std::vector<Corner> corners) const {
        SmoothPath smooth;
        smooth.component = path_.component;
        const std::size_t count = path_.vertices.size();
        Eigen::Vector3d from = at(0);
        addKey(smooth, 0, 0.0, at(0));
        for (std::size_t i = 1; i < count; ++i) {
            const double set_back = i + 1 < count ? corners[i - 1].set_back_m : 0.0;
            if (set_back <= 0.0) {
                smooth.append(from, 0.5 * (from + at(i)), at(i), false);
                addKey(smooth, i, smooth.length_m, at(i));
                from = at(i);
                continue;
            }
            const Curve curve = curveAt(i, set_back);
            smooth.append(from, 0.5 * (from + curve.start), curve.start, false);
            const double before = smooth.length_m;
            smooth.append(curve.start, curve.corner, curve.end, true);
            addKey(smooth, i, 0.5 * (before + smooth.length_m), curve.middle());
            from = curve.end;
        }
        smooth.corners = std::move(corners);
        return smooth;
    }

  private:
    enum class Sampling { Coarse, Fine };  // Coarse: few rays, which may be slightly wrong

    [[nodiscard]] const Eigen::Vector3d& at(std::size_t i) const {
        return path_.vertices[i].position;
    }

    [[nodiscard]] bool isFixed(std::size_t i) const {
        const int key = path_.vertices[i].position_point;
        return key >= 0 && points_[key].fixed;
    }

    /// Whether a camera that looks along its motion must stop here: at a sharp corner, or to turn
    /// to a target at the side.
    [[nodiscard]] bool turnsOnTheSpot(std::size_t i, const Eigen::Vector3d& in,
                                      const Eigen::Vector3d& out) const {
        const HeadingLimit& limit = environment_.heading;
        if (!limit.restricts()) return false;
        if (!limit.allows(in, out)) return true;
        const int key = path_.vertices[i].position_point;
        if (key < 0) return false;
        const int target = points_[key].observation_point;
        const Eigen::Vector3d view = targets_[target].position - at(i);
        return !limit.allows(view, in) || !limit.allows(view, out);
    }

    [[nodiscard]] Curve curveAt(std::size_t i, double set_back) const {
        return {at(i) + set_back * (at(i - 1) - at(i)).normalized(), at(i),
                at(i) + set_back * (at(i + 1) - at(i)).normalized()};
    }

    /// The largest set-back, at most `wish`, that allows() accepts; found to a few per cent.
    [[nodiscard]] double furthest(std::size_t i, double wish) const {
        double refused = 0.0;  // the smallest refused one
        while (wish >= kLeastSetBack && !allows(i, wish)) {
            refused = wish;
            wish *= kShrink;
        }
        if (wish < kLeastSetBack) return wish;
        for (int halving = 0; refused > 0.0 && halving < kHalvings; ++halving) {
            const double between = 0.5 * (wish + refused);
            (allows(i, between) ? wish : refused) = between;
        }
        return wish;
    }

    /// Whether the set-back is collision-free and keeps the captures; the cheaper test comes first.
    [[nodiscard]] bool allows(std::size_t i, double set_back) const {
        const Curve curve = curveAt(i, set_back);
        return environment_.sphere.bezier(curve.start, curve.corner, curve.end).free &&
               keepsCaptures(i, set_back, Sampling::Coarse);
    }

    [[nodiscard]] bool keepsCaptures(std::size_t i, double set_back, Sampling sampling) const {
        const int key = path_.vertices[i].position_point;
        if (key < 0) return true;
        const PositionPoint& point = points_[key];
        const auto& target = targets_[point.observation_point];
        const Pose pose = aim(curveAt(i, set_back).middle(), target.position, environment_.pitch);
        return std::all_of(point.captured.begin(), point.captured.end(), [&](int id) {
            const bool was_well =
                std::binary_search(point.well_captured.begin(), point.well_captured.end(), id);
            const auto isStill = was_well ? isSafelyWellCaptured : isSafelyCaptured;
            const auto coarse = environment_.views.estimate(pose, id, kCoarseCurveGrid);
            const bool whole =
                coarse.rays_on_silhouette >= kEnoughRays && coarse.visible_fraction >= kNearlyWhole;
            if (sampling == Sampling::Coarse || whole) return isStill(coarse) || !coarse.tells();
            return isStill(estimateSurely(environment_.views, pose, id, kFineCurveGrid));
        });
    }

    void addKey(SmoothPath& smooth, std::size_t vertex, double arc,
                const Eigen::Vector3d& position) const {
        const int key = path_.vertices[vertex].position_point;
        if (key >= 0) smooth.keys.push_back({arc, key, position});
    }

    const CameraPath& path_;
    const std::vector<PositionPoint>& points_;
    const std::vector<ObservationPoint>& targets_;
    const PlanningEnvironment& environment_;
    double set_back_;
};

/// Tests the final pieces for collisions and clearance, not the corners they were made from.
void sweepPieces(SmoothPath& smooth, const SweptSphere& sphere) {
    std::vector<SweepResult> sweeps(smooth.pieces.size());
    parallelFor(sweeps.size(), [&](std::size_t i) {
        const SmoothPath::Piece& piece = smooth.pieces[i];
        sweeps[i] = sphere.bezier(piece.start, piece.control, piece.end);
    });
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        const SweepResult& sweep = sweeps[i];
        smooth.collisions += sweep.free ? 0 : 1;
        smooth.corner_collisions += !sweep.free && smooth.pieces[i].curved ? 1 : 0;
        smooth.min_clearance_m = std::min(smooth.min_clearance_m, sweep.min_clearance_m);
    }
}

}  // namespace

Result<SmoothPath> smoothPath(const CameraPath& path,
                              const std::vector<PositionPoint>& position_points,
                              const std::vector<ObservationPoint>& observation_points,
                              const PlanningEnvironment& environment, const SmoothingParams& params,
                              const JobContext& job) {
    const Smoother smoother(path, position_points, observation_points, environment,
                            params.corner_distance_m);
    const std::size_t inner = path.vertices.size() > 2 ? path.vertices.size() - 2 : 0;
    std::vector<Corner> corners(inner);
    parallelFor(inner, [&](std::size_t i) {
        if (!job.cancelled()) corners[i] = smoother.roundCorner(i + 1);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    SmoothPath smooth = smoother.assemble(std::move(corners));
    smooth.min_clearance_m =
        environment.sphere.clearance(path.vertices.front().position, kFarEnough);
    sweepPieces(smooth, environment.sphere);
    return smooth;
}

SmoothPath smoothBlindly(const CameraPath& path, double corner_distance_m,
                         const PlanningEnvironment& environment) {
    const std::vector<PositionPoint> no_points;
    const std::vector<ObservationPoint> no_targets;
    const Smoother smoother(path, no_points, no_targets, environment, corner_distance_m);
    std::vector<Corner> corners;
    for (std::size_t i = 1; i + 1 < path.vertices.size(); ++i) {
        corners.push_back(smoother.roundBlindly(i));
    }
    SmoothPath smooth = smoother.assemble(std::move(corners));
    smooth.min_clearance_m =
        environment.sphere.clearance(path.vertices.front().position, kFarEnough);
    sweepPieces(smooth, environment.sphere);
    return smooth;
}

}  // namespace dollytrack::planning
