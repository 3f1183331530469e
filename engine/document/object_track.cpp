#include "engine/document/object_track.h"

#include <algorithm>

namespace dollytrack {

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

}  // namespace dollytrack
