#include "engine/document/object_track.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

// Moves were converted to degrees and text, so they are compared with a tolerance of 1e-6 m.
constexpr double kHair = 1e-6;

bool isNear(const ObjectMove& a, const ObjectMove& b) {
    return (a.offset_m - b.offset_m).norm() < kHair && std::abs(a.turn_rad - b.turn_rad) < kHair;
}

/// Candidate times at which a track may have its object at this pose: the nearest point on each
/// segment between keys.
void addTimes(const std::vector<TrackKey>& track, const ObjectMove& move,
              std::vector<double>& times) {
    for (std::size_t i = 0; i < track.size(); ++i) {
        times.push_back(track[i].time_s);
        if (i + 1 == track.size()) continue;
        const ObjectMove& from = track[i].move;
        const Eigen::Vector3d way = track[i + 1].move.offset_m - from.offset_m;
        const double turn = track[i + 1].move.turn_rad - from.turn_rad;
        const double square = way.squaredNorm() + turn * turn;
        if (square == 0.0) continue;
        const double share =
            ((move.offset_m - from.offset_m).dot(way) + (move.turn_rad - from.turn_rad) * turn) /
            square;
        // Keys are already candidates; a share close to one would be a duplicate.
        if (share > kHair && share < 1.0 - kHair) {
            times.push_back(track[i].time_s + share * (track[i + 1].time_s - track[i].time_s));
        }
    }
}

}  // namespace

ObjectMove moveAt(const std::vector<TrackKey>& track, double time_s) {
    const auto next = std::ranges::upper_bound(track, time_s, {}, &TrackKey::time_s);
    if (next == track.begin()) return track.front().move;
    const TrackKey& from = *(next - 1);
    if (next == track.end() || from.time_s == time_s) return from.move;
    const double share = (time_s - from.time_s) / (next->time_s - from.time_s);
    return {from.move.offset_m + share * (next->move.offset_m - from.move.offset_m),
            from.move.turn_rad + share * (next->move.turn_rad - from.move.turn_rad)};
}

int putAtTime(SceneEdits& edits, double time_s) {
    int count = 0;
    for (ObjectChange& change : edits.changes) {
        if (change.track.empty()) continue;
        ++count;
        const ObjectMove move = moveAt(change.track, time_s);
        change.move = move.isNone() ? std::nullopt : std::optional(move);
    }
    return count;
}

std::optional<double> timeOfMoves(const SceneEdits& edits, double near_s) {
    std::vector<double> times = {near_s};
    for (const ObjectChange& change : edits.changes) {
        addTimes(change.track, change.move.value_or(ObjectMove{}), times);
    }
    if (times.size() == 1) return std::nullopt;
    std::ranges::stable_sort(times, {}, [&](double time) { return std::abs(time - near_s); });
    const auto found = std::ranges::find_if(times, [&](double time) {
        return std::ranges::all_of(edits.changes, [&](const ObjectChange& change) {
            return change.track.empty() ||
                   isNear(moveAt(change.track, time), change.move.value_or(ObjectMove{}));
        });
    });
    return found == times.end() ? std::nullopt : std::optional(*found);
}

std::vector<TrackKey> withKey(std::vector<TrackKey> track, const TrackKey& key) {
    const auto at = std::ranges::lower_bound(track, key.time_s, {}, &TrackKey::time_s);
    if (at != track.end() && at->time_s == key.time_s) {
        *at = key;
    } else {
        track.insert(at, key);
    }
    return track;
}

std::optional<double> lastKeyTime(const SceneEdits& edits) {
    std::optional<double> last;
    for (const ObjectChange& change : edits.changes) {
        if (change.track.empty()) continue;
        last = std::max(last.value_or(0.0), change.track.back().time_s);
    }
    return last;
}

}  // namespace dollytrack
