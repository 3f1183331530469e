#include "planning/gaze/context_views.h"

#include "engine/jobs/parallel.h"
#include "engine/math/angle.h"
#include "engine/plan/frame_series.h"
#include "planning/gaze/corner_panorama.h"
#include "planning/gaze/panorama.h"
#include "planning/plan_params.h"
#include "planning/timing/clip.h"
#include "planning/timing/motion_limits.h"
#include "planning/timing/turn.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr double kSpacing_m = 0.6;   // distance between two context views
constexpr double kShortest_m = 0.1;  // between closer key frames the camera only turns
constexpr int kMostBetweenKeys = 6;
constexpr double kFramesPerView = 2.0;  // frames of the budget that each key needs
constexpr double kLooksAhead_m = 2.0;
constexpr int kPasses = 3;
// Weights that give more frames of the budget to views of many objects.
constexpr double kWeightAtMean = 4.0;
constexpr double kMostWeight = 8.0;

// Trackability: views with few corners cost extra time in the dynamic programming.
constexpr double kEnoughCorners = 350.0;  // as estimated; ORB finds about 400
// Extra cost of few corners, s per second of a view: see costOfDeficit().
constexpr double kLinearCost = 10.0;
constexpr double kQuarticCost = 30.0;
constexpr double kLeastViewMix = 0.1;  // used if view_mix is smaller
constexpr double kTurnBetweenViews = 40.0 * kDegree;
constexpr double kCheckedTurn = 10.0 * kDegree;
constexpr int kMostInTurn = 4;
constexpr double kManyCorners = 900.0;  // the first view should have so many: SLAM programs start
                                        // with 500

// Directions tried at each position.
constexpr int kHeadings = 36;
constexpr int kElevations = 5;
constexpr double kLowest = -40.0 * kDegree;
constexpr double kElevationStep = 12.5 * kDegree;
constexpr std::size_t kMostCandidates = 14;
constexpr double kApart = 20.0 * kDegree;
using Grid = std::array<double, std::size_t{kHeadings} * kElevations>;

// Upper bounds of the speeds that the cost of a turn assumes.
constexpr double kFastest_mps = 1.5;
constexpr double kFastest_rps = 120.0 * kDegree;
constexpr double kFastest_rps2 = 720.0 * kDegree;

/// A position on the path with the candidate directions of the camera.
struct Place {
    SmoothPath::Key key;
    bool free = false;  // else a key frame, with its own direction only
    std::vector<Eigen::Vector3d> directions = {};
    std::vector<double> values = {};    // by direction
    std::vector<double> deficits = {};  // missing share of kEnoughCorners, by direction
    Grid grid{};                        // value of every grid direction
    Grid grid_deficits{};               // deficit of every grid direction
};

/// A target shown in a view, and how well (0..1).
struct Shown {
    std::uint32_t target = 0;
    float share = 0.0F;
};

Eigen::Vector3d gridDirection(int heading, int elevation, const PitchBand& pitch) {
    const double up = pitch.nearest(kLowest + elevation * kElevationStep);
    const double azimuth = 2.0 * std::numbers::pi * heading / kHeadings;
    return {std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth), std::sin(up)};
}

double gridValue(const Grid& grid, const Eigen::Vector3d& direction) {
    const double azimuth = std::atan2(direction.y(), direction.x()) / (2.0 * std::numbers::pi);
    const int heading = static_cast<int>(std::lround((azimuth + 1.0) * kHeadings)) % kHeadings;
    const int elevation = std::clamp(
        static_cast<int>(std::lround((elevationOf(direction) - kLowest) / kElevationStep)), 0,
        kElevations - 1);
    return grid[elevation * kHeadings + heading];
}

/// Extra cost of a view that lacks this share of kEnoughCorners, s per second. It grows faster than
/// the share, because a SLAM program loses track in the few views without corners, not in the many
/// with half of them.
double costOfDeficit(double share) {
    return kLinearCost * share + kQuarticCost * std::pow(share, 4);
}

class GazeSearch {
  public:
    GazeSearch(std::vector<Place> places, const PlanningEnvironment& environment, double turn_price,
               const TimingParams& timing)
        : places_(std::move(places)),
          pitch_(environment.pitch),
          samples_(environment.views),
          weights_(samples_.targets().size(), 1.0),
          turn_price_(turn_price) {
        const MotionLimits limits = motionLimits(timing);
        speed_mps_ = std::min(limits.speed_mps, kFastest_mps);
        turn_rps_ = std::min(limits.turn_rps, kFastest_rps);
        turn_rps2_ = std::min(limits.turn_acceleration_rps2, kFastest_rps2);
        std::vector<std::unique_ptr<Panorama>> made(places_.size());
        parallelFor(places_.size(), [&](std::size_t i) {
            made[i] =
                std::make_unique<Panorama>(environment.views, samples_, places_[i].key.position);
        });
        for (auto& one : made) panoramas_.push_back(std::move(*one));
        shown_.resize(places_.size());
        if (environment.corners) corners_.resize(places_.size());
        parallelFor(places_.size(), [&](std::size_t i) {
            if (environment.corners) corners_[i] = environment.corners->at(places_[i].key.position);
            for (int e = 0; e < kElevations; ++e) {
                for (int h = 0; h < kHeadings; ++h) {
                    places_[i].grid_deficits[e * kHeadings + h] =
                        cornerDeficit(i, gridDirection(h, e, pitch_));
                    std::vector<Shown>& list = shown_[i][e * kHeadings + h];
                    panoramas_[i].visitShown(
                        gridDirection(h, e, pitch_), [&](std::size_t target, double share) {
                            list.push_back(
                                {static_cast<std::uint32_t>(target), static_cast<float>(share)});
                        });
                }
            }
        });
    }

    struct Result {
        std::vector<Eigen::Vector3d> directions;  // chosen at each position
        std::vector<double> shown;  // mean value between each position and the one before; 0 for
                                    // the first
    };
    Result search() {
        std::vector<Eigen::Vector3d> chosen;
        std::vector<double> shown(places_.size(), 0.0);
        for (const Place& place : places_) chosen.push_back(place.directions.front());
        for (int pass = 0; pass < kPasses; ++pass) {
            parallelFor(places_.size(), [&](std::size_t i) { propose(i, chosen[i]); });
            const double price = std::max(1e-9, meanValue());
            const std::vector<std::size_t> best = bestSequence(price);
            for (std::size_t i = 0; i < places_.size(); ++i) {
                chosen[i] = places_[i].directions[best[i]];
                if (i > 0) shown[i] = step(i - 1, best[i - 1], best[i]).value;
            }
            if (pass + 1 < kPasses) weigh(chosen);
        }
        return {std::move(chosen), std::move(shown)};
    }

  private:
    struct Step {
        double time_s = 0.0;
        double value = 0.0;   // mean over the time
        double cost_s = 0.0;  // of turning
    };

    [[nodiscard]] double valueOf(std::size_t place, const Eigen::Vector3d& direction) const {
        double value = 0.0;
        panoramas_[place].visitShown(direction, [&](std::size_t target, double share) {
            value += weights_[target] * share;
        });
        return value;
    }

    /// The share of kEnoughCorners that a view lacks, 0 to 1; 0 without trackability.
    [[nodiscard]] double cornerDeficit(std::size_t place, const Eigen::Vector3d& direction) const {
        if (corners_.empty()) return 0.0;
        return std::max(0.0, 1.0 - corners_[place]->corners(direction) / kEnoughCorners);
    }

    /// Sets a position's candidates: the direct turn's direction, the one chosen before, and the
    /// best grid directions, at a distance from one another.
    void propose(std::size_t index, const Eigen::Vector3d& chosen) {
        Place& place = places_[index];
        for (std::size_t d = 0; d < place.grid.size(); ++d) {
            place.grid[d] = 0.0;
            for (const Shown& one : shown_[index][d]) {
                place.grid[d] += weights_[one.target] * static_cast<double>(one.share);
            }
        }
        if (place.free) {
            const Eigen::Vector3d direct = place.directions.front();
            place.directions = {direct, chosen};
            std::vector<std::size_t> order(place.grid.size());
            for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
            // With trackability, directions without targets are ranked by their corners.
            const double least = corners_.empty() ? 0.0 : 0.1 * std::ranges::max(place.grid) + 1e-9;
            std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) {
                return (place.grid[i] + least) * (1.0 - place.grid_deficits[i]);
            });
            for (const std::size_t i : order) {
                if (place.directions.size() == kMostCandidates + 2) break;
                const Eigen::Vector3d direction = gridDirection(
                    static_cast<int>(i) % kHeadings, static_cast<int>(i) / kHeadings, pitch_);
                const bool apart = std::none_of(
                    place.directions.begin() + 2, place.directions.end(),
                    [&](const Eigen::Vector3d& d) { return angleBetween(d, direction) < kApart; });
                if (apart) place.directions.push_back(direction);
            }
        }
        place.values.clear();
        place.deficits.clear();
        for (const Eigen::Vector3d& d : place.directions) {
            place.values.push_back(valueOf(index, d));
            place.deficits.push_back(cornerDeficit(index, d));
        }
    }

    [[nodiscard]] double turnTime(double angle) const {
        const double ramp = turn_rps_ * turn_rps_ / turn_rps2_;
        return angle < ramp ? 2.0 * std::sqrt(angle / turn_rps2_)
                            : angle / turn_rps_ + turn_rps_ / turn_rps2_;
    }

    /// A grid's value at a fraction of the turn from one direction to another; `opposite` if the
    /// two are opposite.
    [[nodiscard]] static double valueBetween(const Place& begin, std::size_t a, const Place& end,
                                             std::size_t b, double fraction, Grid Place::*grid,
                                             double opposite) {
        const Eigen::Vector3d along =
            (1.0 - fraction) * begin.directions[a] + fraction * end.directions[b];
        if (along.squaredNorm() < 1e-6) return opposite;
        return (1.0 - fraction) * gridValue(begin.*grid, along.normalized()) +
               fraction * gridValue(end.*grid, along.normalized());
    }

    [[nodiscard]] Step step(std::size_t from, std::size_t a, std::size_t b) const {
        const Place& begin = places_[from];
        const Place& end = places_[from + 1];
        const Eigen::Vector3d& first = begin.directions[a];
        const Eigen::Vector3d& last = end.directions[b];
        const double length = end.key.arc_m - begin.key.arc_m;
        Step made;
        const double angle = angleBetween(first, last);
        const double travel_s = length / speed_mps_;
        made.time_s = travel_s;
        made.cost_s = std::max(0.0, turnTime(angle) - travel_s) + turn_price_ * angle;
        const double between = valueBetween(begin, a, end, b, 0.5, &Place::grid, 0.0);
        made.value = 0.25 * begin.values[a] + 0.5 * between + 0.25 * end.values[b];
        if (!corners_.empty()) {
            double cost =
                0.125 * (costOfDeficit(begin.deficits[a]) + costOfDeficit(end.deficits[b]));
            for (const double fraction : {0.25, 0.5, 0.75}) {
                cost += 0.25 * costOfDeficit(valueBetween(begin, a, end, b, fraction,
                                                          &Place::grid_deficits, 1.0));
            }
            made.cost_s += cost * std::max(travel_s, turnTime(angle));
        }
        return made;
    }

    /// Mean value per second of the direct turns between key frames.
    [[nodiscard]] double meanValue() const {
        double value = 0.0;
        double time_s = 0.0;
        for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
            const Step direct = step(i, 0, 0);
            value += direct.value * direct.time_s;
            time_s += direct.time_s;
        }
        return time_s > 0.0 ? value / time_s : 0.0;
    }

    /// One candidate for each position, maximizing the sum of value / price * travel time minus the
    /// cost of turning.
    [[nodiscard]] std::vector<std::size_t> bestSequence(double price) const {
        std::vector<std::vector<std::size_t>> came_from(places_.size());
        std::vector<double> sums(places_.front().directions.size(), 0.0);
        for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
            const std::size_t ends = places_[i + 1].directions.size();
            std::vector<double> next(ends, -std::numeric_limits<double>::infinity());
            came_from[i + 1].assign(ends, 0);
            for (std::size_t a = 0; a < sums.size(); ++a) {
                for (std::size_t b = 0; b < ends; ++b) {
                    const Step one = step(i, a, b);
                    const double sum = sums[a] + one.value / price * one.time_s - one.cost_s;
                    if (sum <= next[b]) continue;
                    next[b] = sum;
                    came_from[i + 1][b] = a;
                }
            }
            sums = std::move(next);
        }
        std::vector<std::size_t> chosen(places_.size());
        chosen.back() = static_cast<std::size_t>(std::ranges::max_element(sums) - sums.begin());
        for (std::size_t i = places_.size() - 1; i > 0; --i) {
            chosen[i - 1] = came_from[i][chosen[i]];
        }
        return chosen;
    }

    /// Lowers the weight of objects that many of the chosen views show.
    void weigh(const std::vector<Eigen::Vector3d>& chosen) {
        std::vector<double> shown(weights_.size(), 0.0);
        double sum = 0.0;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            panoramas_[i].visitShown(chosen[i], [&](std::size_t target, double share) {
                shown[target] += share;
                sum += share;
            });
        }
        const double mean = std::max(1e-9, sum / static_cast<double>(shown.size()));
        for (std::size_t t = 0; t < shown.size(); ++t) weights_[t] = 1.0 / (1.0 + shown[t] / mean);
    }

    std::vector<Place> places_;
    PitchBand pitch_;
    TargetSamples samples_;
    std::vector<double> weights_;  // by target
    double turn_price_;            // s/rad
    double speed_mps_ = 0.0, turn_rps_ = 0.0, turn_rps2_ = 0.0;
    std::vector<Panorama> panoramas_;                             // by position
    std::vector<std::shared_ptr<const CornerPanorama>> corners_;  // as above; empty without
                                                                  // trackability
    // Targets shown in each grid direction, by position.
    std::vector<std::array<std::vector<Shown>, std::size_t{kHeadings} * kElevations>> shown_;
};

/// The key frames, and the positions between them where a view may be inserted; with
/// `trackability`, large turns get more positions.
std::vector<Place> placesOn(const SmoothPath& path,
                            const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                            const PitchBand& pitch, int max_frames, bool trackability) {
    const std::vector<SmoothPath::Key>& keys = path.keys;
    double spacing = kSpacing_m;
    bool in_short_ones = true;
    bool in_turns = trackability;
    if (max_frames > 0) {
        const double room = max_frames / kFramesPerView - static_cast<double>(keys.size());
        if (room < 1.0) return {};
        spacing = std::max(spacing, path.length_m / room);
        in_short_ones = room > static_cast<double>(keys.size());
        in_turns = trackability && room > kMostInTurn * static_cast<double>(keys.size());
    }
    std::vector<Place> places;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const Eigen::Quaterniond rotation = pose_at(keys[k]).rotation;
        places.push_back({keys[k], false, {rotation * Eigen::Vector3d::UnitZ()}});
        if (k + 1 == keys.size()) break;
        const double length = keys[k + 1].arc_m - keys[k].arc_m;
        const bool on_the_spot = length < kShortest_m;
        if (on_the_spot && !in_turns) continue;
        const Turn turn(rotation, pose_at(keys[k + 1]).rotation, pitch);
        int least = in_short_ones && !on_the_spot ? 1 : 0;
        if (in_turns) {
            const auto in_turn = static_cast<int>(turn.angle() / kTurnBetweenViews);
            least = std::max(least, std::min(kMostInTurn, in_turn));
        }
        const int count =
            std::clamp(static_cast<int>(std::lround(length / spacing)), least, kMostBetweenKeys);
        for (int i = 1; i <= count; ++i) {
            const double share = static_cast<double>(i) / (count + 1);
            SmoothPath::Key key;
            key.arc_m = keys[k].arc_m + share * length;
            key.position = path.at(key.arc_m);
            places.push_back(
                {key, true, {turn.at(share * turn.angle()) * Eigen::Vector3d::UnitZ()}});
        }
    }
    return places;
}

/// Positions for a turn on the spot from a view of many corners to the first key frame's view,
/// preferably past no view with few corners. None if no view has more corners than the key frame's,
/// or if that has enough and each such turn passes a view with few.
std::vector<Place> startingTurn(const Place& first, CornerPanoramas& corners,
                                const PitchBand& pitch) {
    const auto panorama = corners.at(first.key.position);
    const Eigen::Vector3d& towards = first.directions.front();
    const auto worth = [&](const Eigen::Vector3d& direction) {
        return std::min(kManyCorners, panorama->corners(direction));
    };
    const double enough = std::min(kTrackableCorners, worth(towards));
    const auto keepsCorners = [&](const Eigen::Vector3d& from) {
        const Turn turn(lookAlong(from), lookAlong(towards), pitch);
        const int steps = static_cast<int>(turn.angle() / kCheckedTurn);
        for (int i = 1; i <= steps; ++i) {
            const double share = static_cast<double>(i) / (steps + 1);
            if (panorama->corners(turn.at(share * turn.angle())) < enough) return false;
        }
        return true;
    };
    std::vector<std::pair<double, Eigen::Vector3d>> better;
    for (int e = 0; e < kElevations; ++e) {
        for (int h = 0; h < kHeadings; ++h) {
            const Eigen::Vector3d direction = gridDirection(h, e, pitch);
            const double value = worth(direction);
            if (value > worth(towards)) better.emplace_back(value, direction);
        }
    }
    std::ranges::stable_sort(better, std::greater(), [](const auto& one) { return one.first; });
    if (better.empty()) return {};
    const double many = std::min(2.0 * kTrackableCorners, better.front().first);
    const auto found = std::ranges::find_if(
        better, [&](const auto& one) { return one.first >= many && keepsCorners(one.second); });
    // A bare wall on the way is better than one in the first view.
    if (found == better.end() && worth(towards) >= kTrackableCorners) return {};
    const Eigen::Vector3d best = found == better.end() ? better.front().second : found->second;
    std::vector<Place> places;
    const Turn turn(lookAlong(best), lookAlong(towards), pitch);
    const int steps = 1 + std::min(kMostInTurn, static_cast<int>(turn.angle() / kTurnBetweenViews));
    for (int i = 0; i < steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        Place place{first.key, i > 0, {turn.at(share * turn.angle()) * Eigen::Vector3d::UnitZ()}};
        place.key.position_point = -1;
        place.key.looks_at = place.key.position + kLooksAhead_m * best;
        places.push_back(place);
    }
    return places;
}

}  // namespace

SmoothPath withContextViews(const SmoothPath& path,
                            const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                            const PlanningEnvironment& environment, const GazeParams& params,
                            const TimingParams& timing, bool may_start_elsewhere) {
    const bool wanted = params.view_mix > 0.0 || environment.corners;
    if (!wanted || environment.heading.restricts()) return path;
    std::vector<Place> places = placesOn(path, pose_at, environment.pitch, timing.max_frames,
                                         environment.corners != nullptr);
    if (std::ranges::none_of(places, &Place::free)) return path;
    if (environment.corners && may_start_elsewhere) {
        const std::vector<Place> turn =
            startingTurn(places.front(), *environment.corners, environment.pitch);
        places.insert(places.begin(), turn.begin(), turn.end());
    }
    const double view_mix = std::max(params.view_mix, kLeastViewMix);
    const double turn_price = (1.0 - view_mix) / view_mix;
    const auto [directions, shown] = GazeSearch(places, environment, turn_price, timing).search();
    double mean = 0.0;
    for (const double value : shown) mean += value / static_cast<double>(shown.size() - 1);
    const bool spreads = timing.max_frames > 0 && !keepsFrameRate(timing) && mean > 0.0;
    SmoothPath made = path;
    made.keys.clear();
    double shown_since = 0.0;  // mean since the last key
    int steps = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        shown_since = (steps * shown_since + shown[i]) / (steps + 1);
        ++steps;
        SmoothPath::Key key = places[i].key;
        const bool direct = directions[i] == places[i].directions.front();
        if (places[i].free && direct) continue;
        if (places[i].free) key.looks_at = key.position + kLooksAhead_m * directions[i];
        if (spreads) {
            key.frame_weight = std::clamp(kWeightAtMean * shown_since / mean, 1.0, kMostWeight);
        }
        made.keys.push_back(key);
        steps = 0;
        shown_since = 0.0;
    }
    return made;
}

}  // namespace dollytrack::planning
