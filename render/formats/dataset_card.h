#pragma once

#include "engine/plan/capture.h"
#include "render/dataset_contents.h"
#include "render/formats/formats.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::render {

/// What dataset.json calls itself, under `format`.
inline constexpr const char* kDatasetFormat = "dollytrack dataset";

/// Everything dataset.json says that is not in the dataset's other contents.
struct DatasetCard {
    std::string product_version;
    std::uint64_t seed = 0;
    nlohmann::json parameters;       // of planning, by section and name
    nlohmann::json edits;            // made by hand; an empty object without any
    nlohmann::json planned_metrics;  // as planning estimated them, null when there are none
    CaptureMetrics counted;          // from the pixels
    std::vector<ObjectCapture> captures;
    FormatSet formats;
    std::vector<ObjectRelation> relations;
    std::string geometry_sha256;  // see scene_hash.h
    std::string appearance_sha256;
    std::string whole_trajectory_sha256;         // see motion_hash.h
    std::string whole_motions_sha256;            // of objects
    std::map<std::string, std::string> sha256s;  // of every other file, by relative path
};

/// What dataset.json says: which conventions the files follow, what they show, and how they came
/// to be. Holds no clock, so that equal input gives equal bytes.
[[nodiscard]] nlohmann::ordered_json datasetCardJson(const DatasetContents& contents,
                                                     const DatasetCard& card);

}  // namespace dollytrack::render
