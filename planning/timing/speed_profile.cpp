#include "planning/timing/speed_profile.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSame = 1e-9;   // m
constexpr int kCurveSteps = 4;   // per part of a curve; even, so that a motion from rest to rest is
                                 // exact
constexpr int kRampSteps = 2;    // from rest to full speed
constexpr int kShortSteps = 8;   // on a straight part too short for both ramps
constexpr int kCruiseSteps = 4;  // between the ramps
// In a curve, the lateral acceleration takes at most this share of the limit; sqrt(1 - 0.8^2) is
// left for speeding up and braking.
constexpr double kAcross = 0.8;
// Directions that differ by less are one line with rounding errors; others are a corner where the
// camera stops.
constexpr double kStraightAngle = 0.51 * std::numbers::pi / 180.0;
// The velocity may change at such a kink by what the acceleration limit allows in this time.
constexpr double kJolt_s = 0.002;

// A curve around a corner sharper than this reverses: the camera stops at its tip.
constexpr double kTurnsBack = 179.0 * std::numbers::pi / 180.0;
constexpr double kBesideTip = 0.6;  // share of the acceleration

/// Direction of a piece at its start or end.
Eigen::Vector3d beginOf(const SmoothPath::Piece& piece) {
    return piece.curved ? piece.control - piece.start : piece.end - piece.start;
}
Eigen::Vector3d endOf(const SmoothPath::Piece& piece) {
    return piece.curved ? piece.end - piece.control : piece.end - piece.start;
}

double kinkBetween(const Eigen::Vector3d& in, const Eigen::Vector3d& out) {
    return std::atan2(in.cross(out).norm(), in.dot(out));
}

/// Squared speed limit at the joint of two pieces.
double jointLimit2(const SmoothPath::Piece& before, const SmoothPath::Piece& after,
                   const MotionLimits& limits) {
    const double kink = kinkBetween(endOf(before), beginOf(after));
    if (kink > kStraightAngle) return 0.0;
    const double fastest = kJolt_s * limits.acceleration_mps2 / std::max(kink, 1e-12);
    return fastest * fastest;
}

}  // namespace

SpeedProfile::SpeedProfile(const SmoothPath& path, const MotionLimits& limits) {
    cut(path, limits);
    key_limit2_.assign(key_nodes_.size(), kInfinity);
    for (std::size_t k = 0; k + 1 < key_nodes_.size(); ++k) {
        // Two keys at one position: the camera turns on the spot.
        if (key_nodes_[k] == key_nodes_[k + 1]) nodes_[key_nodes_[k]].limit2 = 0.0;
    }
    nodes_[key_nodes_.front()].limit2 = 0.0;
    nodes_[key_nodes_.back()].limit2 = 0.0;
}

void SpeedProfile::cut(const SmoothPath& path, const MotionLimits& limits) {
    nodes_.push_back({path.keys.front().arc_m, kInfinity, 0.0, 0.0, 0.0});
    key_nodes_.push_back(0);
    std::size_t piece = path.pieceAt(nodes_.front().arc_m);
    for (std::size_t k = 1; k < path.keys.size(); ++k) {
        const double end = path.keys[k].arc_m;
        while (end - nodes_.back().arc_m > kSame && piece < path.pieces.size()) {
            const SmoothPath::Piece& p = path.pieces[piece];
            const double piece_end = p.begin_m + p.length_m;
            const double until = piece_end > end - kSame ? end : piece_end;
            if (until - nodes_.back().arc_m > kSame) {
                addSteps(p, nodes_.back().arc_m, until, limits);
            }
            if (piece_end > end + kSame || piece + 1 == path.pieces.size()) break;
            nodes_.back().limit2 =
                std::min(nodes_.back().limit2, jointLimit2(p, path.pieces[piece + 1], limits));
            ++piece;
        }
        key_nodes_.push_back(nodes_.size() - 1);
    }
}

void SpeedProfile::addSteps(const SmoothPath::Piece& piece, double from, double to,
                            const MotionLimits& limits) {
    const double length = to - from;
    const double most2 = limits.speed_mps * limits.speed_mps;
    const auto step = [&](double until, double limit2, double acceleration) {
        Node& last = nodes_.back();
        last.limit2 = std::min(last.limit2, limit2);
        last.gain2 = 2.0 * acceleration * (until - last.arc_m);
        nodes_.push_back({until, limit2, 0.0, 0.0, 0.0});
    };
    const bool turns_back = piece.curved && kinkBetween(beginOf(piece), endOf(piece)) > kTurnsBack;
    if (piece.curved && !turns_back) {
        const auto parameter = [&](int i) {
            return piece.parameterAt(from + length * i / kCurveSteps - piece.begin_m);
        };
        double before = parameter(0);
        for (int i = 1; i <= kCurveSteps; ++i) {
            const double after = parameter(i);
            // The curvature is largest at one of the step's ends, or at the middle of the curve.
            const double middle = std::clamp(0.5, before, after);
            const double bend = std::max(
                {piece.curvature(before), piece.curvature(middle), piece.curvature(after), 1e-9});
            const double limit2 = std::min(most2, kAcross * limits.acceleration_mps2 / bend);
            const double along =
                std::sqrt(std::max(0.0, limits.acceleration_mps2 * limits.acceleration_mps2 -
                                            limit2 * bend * limit2 * bend));
            step(i == kCurveSteps ? to : from + length * i / kCurveSteps, limit2, along);
            before = after;
        }
        return;
    }
    // Near the tip of such a curve, its curvature takes part of the acceleration.
    const double acceleration = (turns_back ? kBesideTip : 1.0) * limits.acceleration_mps2;
    const double ramp = 0.5 * most2 / acceleration;
    const auto evenly = [&](double begin, double end, int count) {
        for (int i = 1; i <= count; ++i) {
            step(i == count ? end : begin + (end - begin) * i / count, most2, acceleration);
        }
    };
    const auto straight = [&](double begin, double end) {
        if (end - begin < 2.5 * ramp) {
            evenly(begin, end, kShortSteps);
            return;
        }
        evenly(begin, begin + ramp, kRampSteps);
        evenly(begin + ramp, end - ramp, kCruiseSteps);
        evenly(end - ramp, end, kRampSteps);
    };
    if (!turns_back) return straight(from, to);
    const double tip = piece.begin_m + 0.5 * piece.length_m;
    const double middle = std::clamp(tip, from, to);
    if (middle - from > kSame) straight(from, middle);
    if (std::abs(tip - middle) <= kSame) nodes_.back().limit2 = 0.0;
    if (to - middle > kSame) straight(middle, to);
}

void SpeedProfile::findFastest() {
    for (Node& node : nodes_) node.fastest2 = node.limit2;
    for (std::size_t k = 0; k < key_nodes_.size(); ++k) {
        Node& node = nodes_[key_nodes_[k]];
        node.fastest2 = std::min(node.fastest2, key_limit2_[k]);
    }
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
        nodes_[i].fastest2 =
            std::min(nodes_[i].fastest2, nodes_[i - 1].fastest2 + nodes_[i - 1].gain2);
    }
    for (std::size_t i = nodes_.size() - 1; i > 0; --i) {
        nodes_[i - 1].fastest2 =
            std::min(nodes_[i - 1].fastest2, nodes_[i].fastest2 + nodes_[i - 1].gain2);
    }
}

void SpeedProfile::findSlowest(std::size_t segment) {
    const std::size_t begin = key_nodes_[segment];
    const std::size_t end = key_nodes_[segment + 1];
    double speed2 = nodes_[begin].fastest2;
    for (std::size_t i = begin; i <= end; ++i) {
        nodes_[i].slowest2 = std::max(0.0, speed2);
        speed2 -= nodes_[i].gain2;
    }
    speed2 = nodes_[end].fastest2;
    for (std::size_t i = end; i > begin; --i) {
        nodes_[i].slowest2 = std::max(nodes_[i].slowest2, speed2);
        speed2 -= nodes_[i - 1].gain2;
    }
}

double SpeedProfile::speed2(std::size_t node, double cap2) const {
    return std::max(std::min(nodes_[node].fastest2, cap2), nodes_[node].slowest2);
}

double SpeedProfile::timeAtCap(std::size_t segment, double cap2) const {
    double time = 0.0;
    const std::size_t begin = key_nodes_[segment];
    // The slowest speeds at the keys belong to the neighbouring segments.
    double speed = std::sqrt(nodes_[begin].fastest2);
    for (std::size_t i = begin; i < key_nodes_[segment + 1]; ++i) {
        const bool last = i + 1 == key_nodes_[segment + 1];
        const double next = std::sqrt(last ? nodes_[i + 1].fastest2 : speed2(i + 1, cap2));
        if (speed + next <= 0.0) return kInfinity;
        time += 2.0 * (nodes_[i + 1].arc_m - nodes_[i].arc_m) / (speed + next);
        speed = next;
    }
    return time;
}

std::vector<std::size_t> SpeedProfile::settle(double interval_s,
                                              const std::vector<double>& least_times_s) {
    std::fill(key_limit2_.begin(), key_limit2_.end(), kInfinity);
    std::vector<std::size_t> intervals(segmentCount(), 1);
    constexpr int kRounds = 60;
    for (int round = 0; round <= kRounds; ++round) {
        if (round == kRounds) std::fill(key_limit2_.begin(), key_limit2_.end(), 0.0);
        findFastest();
        bool settled = true;
        for (std::size_t s = 0; s < segmentCount(); ++s) {
            findSlowest(s);
            const double least = std::max(timeAtCap(s, kInfinity), least_times_s[s]);
            intervals[s] =
                static_cast<std::size_t>(std::max(1.0, std::ceil(least / interval_s - 1e-9)));
            if (key_nodes_[s] == key_nodes_[s + 1]) continue;
            const double time = interval_s * static_cast<double>(intervals[s]);
            if (timeAtCap(s, 0.0) >= time * (1.0 - 1e-9)) continue;
            // Too fast at the ends to take that long: limit both keys to the mean speed.
            const double mean =
                (nodes_[key_nodes_[s + 1]].arc_m - nodes_[key_nodes_[s]].arc_m) / time;
            for (const std::size_t key : {s, s + 1}) {
                key_limit2_[key] = std::min(key_limit2_[key], mean * mean);
            }
            settled = false;
        }
        if (settled) break;
    }
    return intervals;
}

double SpeedProfile::capFor(std::size_t segment, double time_s) const {
    double most2 = 0.0;
    for (std::size_t i = key_nodes_[segment]; i <= key_nodes_[segment + 1]; ++i) {
        most2 = std::max(most2, nodes_[i].fastest2);
    }
    const double length = nodes_[key_nodes_[segment + 1]].arc_m - nodes_[key_nodes_[segment]].arc_m;
    const double wanted = length / time_s;
    // The mean speed grows almost linearly with the cap: solve by regula falsi (Illinois).
    const auto excess = [&](double cap) { return length / timeAtCap(segment, cap * cap) - wanted; };
    double low = 0.0;
    double high = std::sqrt(most2);
    double at_low = excess(low);
    double at_high = excess(high);
    if (at_high <= 0.0) return most2;
    if (at_low >= 0.0) return 0.0;
    double cap = high;
    int side = 0;  // side of the last step; an end kept twice has its value halved
    for (int i = 0; i < 60; ++i) {
        cap = (low * at_high - high * at_low) / (at_high - at_low);
        const double at_cap = excess(cap);
        if (std::abs(at_cap) <= 1e-10 * wanted) break;
        if (at_cap > 0.0) {
            high = cap;
            at_high = at_cap;
            if (side == 1) at_low *= 0.5;
            side = 1;
        } else {
            low = cap;
            at_low = at_cap;
            if (side == -1) at_high *= 0.5;
            side = -1;
        }
    }
    return cap * cap;
}

std::vector<double> SpeedProfile::arcs(std::size_t segment, double time_s,
                                       std::size_t intervals) const {
    const std::size_t begin = key_nodes_[segment];
    const std::size_t end = key_nodes_[segment + 1];
    if (begin == end || intervals < 2) {
        return std::vector<double>(intervals - 1, nodes_[begin].arc_m);
    }
    const double cap2 = capFor(segment, time_s);
    std::vector<double> arcs;
    arcs.reserve(intervals - 1);
    double node_time = 0.0;
    double speed = std::sqrt(nodes_[begin].fastest2);
    for (std::size_t i = begin; i < end && arcs.size() + 1 < intervals; ++i) {
        const double next = std::sqrt(i + 1 == end ? nodes_[end].fastest2 : speed2(i + 1, cap2));
        const double length = nodes_[i + 1].arc_m - nodes_[i].arc_m;
        const double spent = 2.0 * length / (speed + next);
        while (arcs.size() + 1 < intervals) {
            const double since =
                time_s * static_cast<double>(arcs.size() + 1) / static_cast<double>(intervals) -
                node_time;
            if (since > spent) break;
            arcs.push_back(nodes_[i].arc_m +
                           since * (speed + 0.5 * (next - speed) * since / spent));
        }
        node_time += spent;
        speed = next;
    }
    while (arcs.size() + 1 < intervals) arcs.push_back(nodes_[end].arc_m);  // rounding
    return arcs;
}

}  // namespace dollytrack::planning
