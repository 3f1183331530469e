#pragma once

#include "engine/document/edits.h"

namespace dollytrack {

/// Where a track has its object at a time: straight on from key to key, offset and turn alike; at
/// rest before the first and after the last. The track has at least one key.
ObjectMove moveAt(const std::vector<TrackKey>& track, double time_s);

/// Moves every object that has a track to where that has it at the time. Returns how many have one.
int putAtTime(SceneEdits& edits, double time_s);

}  // namespace dollytrack
