#pragma once

#include "render/verify/read/image_files.h"
#include "render/verify/read/stored_dataset.h"

#include <string>
#include <vector>

namespace dollytrack::verify {

/// The tracks of a clip. Arrays with an entry per frame have a row for each track and a column for
/// each frame.
struct StoredTracks {
    ImageF points;    // px, right and down
    ImageF places;    // world, m
    Image8 occluded;  // 1: not visible
    ImageF queries;   // a row for each track: frame counted from the clip's first, y, x
    Image16 object_ids;

    [[nodiscard]] int count() const { return points.height; }
};

/// Number of frames in a clip by dataset.json; 0 if it is missing or invalid.
int clipFrames(const StoredDataset& dataset);

/// Name of an array of the clip that begins at a frame, for example "tracks/000300_points.npy".
std::string trackFile(int first_frame, const char* array);

/// The files of the clip that begins at a frame; none if none begins there or the dataset has no
/// tracks.
std::vector<std::string> trackFiles(const StoredDataset& dataset, int frame);

/// Reads the clip that begins at a frame. Returns BadInput naming the file if one cannot be read or
/// the shapes do not fit each other and the number of frames.
Result<StoredTracks> readTracks(const StoredDataset& dataset, int first_frame);

}  // namespace dollytrack::verify
