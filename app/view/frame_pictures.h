#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/pictures/small_picture.h"
#include "render/verify/read/stored_dataset.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::view {

/// Small images of one kind.
struct PictureKind {
    std::string modality;
    std::string text;                              // for people
    std::vector<std::vector<std::uint8_t>> files;  // by frame; empty where there is none
};

struct FramePictures {
    render::SmallPictureSize size;
    std::vector<PictureKind> kinds;  // those that the dataset has
    std::vector<bool> chosen;        // by frame: whether its images were chosen for the page
    int unreadable = 0;              // images of chosen frames that are gone or damaged
};

/// Small images of a dataset's frames that take at most `most_bytes` as base64: of all frames, as
/// large as fits. Where even the smallest are too many, of the frames in `first` and of others at
/// even distances, as many as fit. Errors: BadInput; Cancelled.
[[nodiscard]] Result<FramePictures> makeFramePictures(const verify::StoredDataset& dataset,
                                                      const std::vector<int>& first,
                                                      std::size_t most_bytes,
                                                      const JobContext& job);

}  // namespace dollytrack::view
