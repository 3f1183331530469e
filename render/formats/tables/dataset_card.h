#pragma once

#include "engine/plan/capture.h"
#include "render/dataset/dataset_contents.h"
#include "render/formats/formats.h"

#include <nlohmann/json.hpp>

#include <array>
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
    PictureTally pictures;
    std::vector<ObjectCapture> captures;
    FormatSet formats;
    std::vector<ObjectRelation> relations;
    std::string geometry_sha256;  // see scene_hash.h
    std::string appearance_sha256;
    std::string whole_trajectory_sha256;         // see motion_hash.h
    std::string whole_motions_sha256;            // of objects
    std::map<std::string, std::string> sha256s;  // of every other file, by relative path
};

/// The shares of unusable pictures in what pictureTallyJson() gives, as --require names them.
inline constexpr std::array<const char*, 3> kPictureRates = {"dark_rate", "white_rate",
                                                             "flat_rate"};

/// {"measured": 60, "dark": [3, 4], ..., "dark_rate": 0.033, ...}; without pictures rates are null.
[[nodiscard]] nlohmann::ordered_json pictureTallyJson(const PictureTally& tally);
/// What that says. Throws nlohmann's exceptions.
[[nodiscard]] PictureTally pictureTallyFrom(const nlohmann::ordered_json& value);

/// What dataset.json says: which conventions the files follow, what they show, and how they came
/// to be. Holds no clock, so that equal input gives equal bytes.
[[nodiscard]] nlohmann::ordered_json datasetCardJson(const DatasetContents& contents,
                                                     const DatasetCard& card);

}  // namespace dollytrack::render
