#pragma once

#include "engine/document/edits.h"

#include <optional>
#include <vector>

namespace dollytrack {

/// The displacement at a time: linear interpolation of offset and turn between the keys; constant
/// before the first and after the last key. The track must have at least one key.
ObjectMove moveAt(const std::vector<TrackKey>& track, double time_s);

/// Moves every object that has a track to its displacement at this time. Returns the number of such
/// objects.
int putAtTime(SceneEdits& edits, double time_s);

/// A time at which every tracked object's displacement equals that of its track; of several such
/// times the one closest to `near_s`. Empty if there is none, or no track.
std::optional<double> timeOfMoves(const SceneEdits& edits, double near_s);

/// Adds a key to a track; it replaces a key of the same time.
std::vector<TrackKey> withKey(std::vector<TrackKey> track, const TrackKey& key);

/// Time of the last key of all tracks; empty if there is no track.
std::optional<double> lastKeyTime(const SceneEdits& edits);

}  // namespace dollytrack
