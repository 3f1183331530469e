#include "planning/gaze/room_views.h"

#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/math/angle.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/gaze/panorama.h"
#include "planning/plan_params.h"
#include "planning/timing/clip.h"
#include "planning/viewpoints/fixed_points.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kPlaces = 100;
constexpr std::size_t kDraws = 4 * kPlaces;
constexpr double kLeastClearance_m = 0.25;  // in addition to the camera radius
// Height of the camera between the surfaces below and above it, as a share; distances are capped.
constexpr double kLowest = 0.35, kHighest = 0.75;
constexpr double kTallest_m = 2.0;

constexpr int kHeadings = 24;
constexpr std::array kElevations{-30.0 * kDegree, -17.5 * kDegree, -5.0 * kDegree};
constexpr std::size_t kAims = 5;  // directions kept per position
constexpr double kApart = 30.0 * kDegree;

constexpr std::size_t kSides = 6;       // of an object, around the vertical
constexpr double kOtherSides = 0.25;    // weight of views from other sides
constexpr double kWorthTheWay_m = 3.0;  // distance from other views at which a view must gain twice
                                        // as much
constexpr double kFramesPerView = 3.0;  // frames that a key frame and the path to it take
constexpr double kMostPerKeyFrame = 2.25;  // with view_mix=1
constexpr double kLeastGain = 0.1;         // relative to the first view

struct ShownTarget {
    std::size_t target = 0;
    std::size_t side = 0;
    double share = 0.0;
};

struct Choice {
    Pose pose;
    std::vector<ShownTarget> shown;
};

/// Counts how often the chosen views show each object, by side.
class Shown {
  public:
    explicit Shown(std::size_t targets) : by_side_(targets), all_(targets, 0.0) {}

    void add(const std::vector<ShownTarget>& view) {
        for (const ShownTarget& one : view) {
            by_side_[one.target][one.side] += one.share;
            all_[one.target] += one.share;
        }
    }
    [[nodiscard]] double gain(const std::vector<ShownTarget>& view) const {
        double sum = 0.0;
        for (const ShownTarget& one : view) {
            const double before = by_side_[one.target][one.side];
            sum += one.share / (1.0 + before + kOtherSides * (all_[one.target] - before));
        }
        return sum;
    }

  private:
    std::vector<std::array<double, kSides>> by_side_;
    std::vector<double> all_;
};

bool atEyeLevel(const Eigen::Vector3d& place, const RayCaster& rays) {
    const auto room = [&](double up) {
        const RayHit hit = rays.cast(place, Eigen::Vector3d(0.0, 0.0, up));
        return hit.object_id == 0 ? kTallest_m : std::min(hit.distance, kTallest_m);
    };
    const double below = room(-1.0);
    const double share = below / (below + room(1.0));
    return share > kLowest && share < kHighest;
}

/// Random free positions in these components, with clearance around the camera and at eye level;
/// filled up with other free positions if there are too few.
std::vector<Eigen::Vector3d> drawPlaces(const PlanningEnvironment& environment,
                                        const std::set<int>& components, int seed) {
    std::vector<const Eigen::Vector3f*> cells;
    for (const int component : components) {
        for (const Eigen::Vector3f& cell : environment.sphere.cells(component))
            cells.push_back(&cell);
    }
    if (cells.empty()) return {};
    Random random(static_cast<std::uint64_t>(seed), kPlaces);
    std::vector<Eigen::Vector3d> drawn;
    for (std::size_t i = 0; i < kDraws; ++i) {
        drawn.push_back(
            cells[random.below(static_cast<std::uint32_t>(cells.size()))]->cast<double>());
    }
    enum class Fit { No, Tight, Roomy };
    std::vector<Fit> fits(drawn.size(), Fit::No);
    const double clearance = environment.sphere.radius() + kLeastClearance_m;
    parallelFor(drawn.size(), [&](std::size_t i) {
        if (!environment.sphere.fits(drawn[i])) return;
        fits[i] = environment.sphere.clearance(drawn[i], clearance) >= clearance &&
                          atEyeLevel(drawn[i], environment.views.rays())
                      ? Fit::Roomy
                      : Fit::Tight;
    });
    std::vector<Eigen::Vector3d> places;
    for (const Fit wanted : {Fit::Roomy, Fit::Tight}) {
        for (std::size_t i = 0; i < drawn.size() && places.size() < kPlaces; ++i) {
            if (fits[i] == wanted) places.push_back(drawn[i]);
        }
    }
    return places;
}

class RoomViewSearch {
  public:
    explicit RoomViewSearch(const PlanningEnvironment& environment)
        : environment_(environment),
          samples_(environment.views),
          shown_(samples_.targets().size()) {}

    /// Counts the objects that a key frame captures as shown.
    void count(const PositionPoint& key) {
        std::vector<ShownTarget> shown;
        for (std::size_t t = 0; t < samples_.targets().size(); ++t) {
            const int id = samples_.targets()[t].object_id;
            if (std::ranges::binary_search(key.captured, id)) {
                shown.push_back({t, sideOf(key.pose, id), 1.0});
            }
        }
        shown_.add(shown);
    }

    void propose(const std::vector<Eigen::Vector3d>& places) {
        std::vector<std::vector<Choice>> at(places.size());
        parallelFor(places.size(), [&](std::size_t i) { at[i] = aimsAt(places[i]); });
        for (auto& choices : at) {
            for (Choice& choice : choices) choices_.push_back(std::move(choice));
        }
    }

    std::vector<Pose> choose(const std::vector<Pose>& given, std::size_t most) {
        std::vector<double> distance(choices_.size(), std::numeric_limits<double>::infinity());
        const auto visit = [&](const Eigen::Vector3d& place) {
            for (std::size_t i = 0; i < choices_.size(); ++i) {
                distance[i] = std::min(distance[i], (choices_[i].pose.position - place).norm());
            }
        };
        for (const Pose& pose : given) visit(pose.position);
        std::vector<Pose> chosen;
        double first = 0.0;
        while (chosen.size() < most) {
            std::size_t best = 0;
            double best_worth = 0.0;
            double best_gain = 0.0;
            for (std::size_t i = 0; i < choices_.size(); ++i) {
                const double gain = shown_.gain(choices_[i].shown);
                const double worth = gain / (1.0 + distance[i] / kWorthTheWay_m);
                if (worth <= best_worth) continue;
                best = i;
                best_worth = worth;
                best_gain = gain;
            }
            first = std::max(first, best_gain);
            if (best_gain <= kLeastGain * first) break;
            chosen.push_back(choices_[best].pose);
            shown_.add(choices_[best].shown);
            visit(choices_[best].pose.position);
        }
        return chosen;
    }

  private:
    /// Index of the side of the object that the camera is on.
    [[nodiscard]] std::size_t sideOf(const Pose& pose, int object_id) const {
        const Eigen::Vector3d way =
            pose.position - environment_.views.scene().object(object_id).box.center;
        const double turns = std::atan2(way.y(), way.x()) / (2.0 * std::numbers::pi);
        return static_cast<std::size_t>((turns + 1.0) * kSides) % kSides;
    }

    [[nodiscard]] std::vector<ShownTarget> shownIn(const Panorama& panorama,
                                                   const Pose& pose) const {
        std::vector<ShownTarget> shown;
        panorama.visitShown(pose.forward(), [&](std::size_t target, double share) {
            const int id = samples_.targets()[target].object_id;
            shown.push_back({target, sideOf(pose, id), share});
        });
        return shown;
    }

    [[nodiscard]] std::vector<Choice> aimsAt(const Eigen::Vector3d& place) const {
        const Panorama panorama(environment_.views, samples_, place);
        std::vector<std::pair<double, Choice>> all;
        for (const double elevation : kElevations) {
            const double up = environment_.pitch.nearest(elevation);
            for (int h = 0; h < kHeadings; ++h) {
                const double heading = 2.0 * std::numbers::pi * h / kHeadings;
                const Eigen::Vector3d direction(std::cos(up) * std::cos(heading),
                                                std::cos(up) * std::sin(heading), std::sin(up));
                Choice choice{{place, lookAlong(direction)}, {}};
                choice.shown = shownIn(panorama, choice.pose);
                all.emplace_back(-shown_.gain(choice.shown), std::move(choice));
            }
        }
        std::ranges::stable_sort(all, {}, &std::pair<double, Choice>::first);
        std::vector<Choice> kept;
        for (auto& [gain, choice] : all) {
            if (kept.size() == kAims || gain >= 0.0) break;
            const bool apart = std::ranges::none_of(kept, [&](const Choice& other) {
                return angleBetween(other.pose.forward(), choice.pose.forward()) < kApart;
            });
            if (apart) kept.push_back(std::move(choice));
        }
        return kept;
    }

    const PlanningEnvironment& environment_;
    TargetSamples samples_;
    Shown shown_;
    std::vector<Choice> choices_;
};

/// Largest number of room views for a tour of `key_frames`: view_mix times kMostPerKeyFrame for
/// each key frame, or times the number of views that the budget of frames allows beside the key
/// frames, whichever is smaller.
std::size_t mostRoomViews(const PlanParams& params, std::size_t key_frames) {
    const auto keys = static_cast<double>(key_frames);
    double most = kMostPerKeyFrame * keys;
    if (params.timing.max_frames > 0) {
        most = std::clamp(params.timing.max_frames / kFramesPerView - keys, 0.0, most);
    }
    return static_cast<std::size_t>(params.gaze.view_mix * most);
}

}  // namespace

bool asksForRoomViews(const PlanParams& params) {
    return params.gaze.view_mix > 0.0 && params.coverage.objective != Objective::Surface &&
           params.body.heading == Heading::Free && params.path.path_mode == PathMode::Tour &&
           params.path.max_length_m <= 0.0 && !keepsFrameRate(params.timing);
}

void addRoomViews(const PlanParams& params, const PlanningEnvironment& environment,
                  Viewpoints& viewpoints) {
    RoomViewSearch search(environment);
    std::vector<Pose> given;
    std::set<int> components;
    for (const int key : chooseKeyFrames(viewpoints.position_points)) {
        const PositionPoint& point = viewpoints.position_points[key];
        search.count(point);
        given.push_back(point.pose);
        components.insert(point.component);
    }
    const std::size_t most = mostRoomViews(params, given.size());
    if (most == 0) return;
    search.propose(drawPlaces(environment, components, params.seed));
    for (const Pose& view : search.choose(given, most)) {
        addFixedPoint(view, environment, viewpoints);
        viewpoints.position_points.back().fixed = false;
        viewpoints.position_points.back().room_view = true;
    }
}

}  // namespace dollytrack::planning
