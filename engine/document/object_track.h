#pragma once

#include "engine/document/edits.h"

#include <optional>
#include <vector>

namespace dollytrack {

/// Where a track has its object at a time: straight on from key to key, offset and turn alike; at
/// rest before the first and after the last. The track has at least one key.
ObjectMove moveAt(const std::vector<TrackKey>& track, double time_s);

/// Moves every object that has a track to where that has it at the time. Returns how many have one.
int putAtTime(SceneEdits& edits, double time_s);

/// The time at which all objects that have a track stand where that has them: `near_s` where that
/// is one, else the nearest to it. Nothing where there is none, or no track.
std::optional<double> timeOfMoves(const SceneEdits& edits, double near_s);

/// The track with this key, in place of one of the same time.
std::vector<TrackKey> withKey(std::vector<TrackKey> track, const TrackKey& key);

/// When the last key of all tracks is; nothing without a track.
std::optional<double> lastKeyTime(const SceneEdits& edits);

}  // namespace dollytrack
