#pragma once

#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/verify/read/stored_dataset.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace dollytrack::view {

/// The page stays below this.
inline constexpr std::size_t kMostPageBytes = 10'000'000;

/// Where Debian's package libjs-three has three.js.
inline constexpr const char* kThreeFolder = "/usr/share/javascript/three";

struct PageOrder {
    const verify::StoredDataset& dataset;
    const Scene* scene = nullptr;  // null: the page shows boxes and the trajectory alone
    const RayCaster* rays = nullptr;
    std::string no_scene;  // why there is no scene, for people
    std::filesystem::path three_folder = kThreeFolder;
};

struct DatasetPage {
    std::string html;
    std::size_t triangles = 0;
    int pictures_of_frames = 0;
    int picture_width_px = 0;  // 0 without images
    int unreadable_pictures = 0;
};

/// One HTML page that shows a dataset and needs no other file. Equal input gives equal bytes.
/// Errors: BadInput, also where three.js is missing or the dataset is too large for a page;
/// Cancelled.
[[nodiscard]] Result<DatasetPage> makeDatasetPage(const PageOrder& order, const JobContext& job);

}  // namespace dollytrack::view
