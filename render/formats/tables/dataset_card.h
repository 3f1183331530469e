#pragma once

#include "engine/plan/capture.h"
#include "render/dataset/contents/dataset_contents.h"
#include "render/dataset/contents/format.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Value of `format` in dataset.json.
inline constexpr const char* kDatasetFormat = "dollytrack dataset";
inline constexpr int kDatasetVersion = 1;

/// The licences of the scene's models; only in datasets of scenes that have licence files.
inline constexpr const char* kLicensesFile = "LICENSES";
inline constexpr std::size_t kMostLicenseBytes = std::size_t{1} << 20U;

/// Contents of dataset.json that are not in DatasetContents.
struct DatasetCard {
    std::string product_version;
    std::uint64_t seed = 0;
    nlohmann::json parameters;       // of planning, by section and name
    nlohmann::json edits;            // manual edits; an empty object if there are none
    nlohmann::json planned_metrics;  // as estimated by planning; null if unknown
    CaptureMetrics counted;          // measured from the pixels
    PictureTally pictures;
    std::vector<ObjectCapture> captures;
    FormatSet formats;
    std::vector<ObjectRelation> relations;
    std::string licenses;         // content of kLicensesFile; empty: the file is not written
    std::string geometry_sha256;  // see scene_hash.h
    std::string appearance_sha256;
    std::string whole_trajectory_sha256;         // see motion_hash.h
    std::string whole_motions_sha256;            // of moving objects
    std::map<std::string, std::string> sha256s;  // of all other files, by relative path
};

/// Keys of the shares of unusable images in pictureTallyJson(), also names for --require.
inline constexpr std::array<const char*, 3> kPictureRates = {"dark_rate", "white_rate",
                                                             "flat_rate"};

/// {"measured": 60, "dark": [3, 4], ..., "dark_rate": 0.033, ...}; rates are null without images.
[[nodiscard]] nlohmann::ordered_json pictureTallyJson(const PictureTally& tally);
/// Inverse of pictureTallyJson(). Throws nlohmann's exceptions.
[[nodiscard]] PictureTally pictureTallyFrom(const nlohmann::ordered_json& value);

/// The content of dataset.json: conventions of the files, objects and frames, results and origin.
/// It contains no date or time, so that equal input gives equal bytes.
[[nodiscard]] nlohmann::ordered_json datasetCardJson(const DatasetContents& contents,
                                                     const DatasetCard& card);

}  // namespace dollytrack::render
