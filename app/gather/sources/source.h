#pragma once

#include "app/gather/files/source_file.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/scene/class_table.h"
#include "render/verify/read/stored_dataset.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gather {

/// The image kinds that most layouts hold; rgb is always.
inline constexpr const char* kPicture = "rgb";
inline constexpr const char* kDepth = "depth";
inline constexpr const char* kInstance = "instance";
inline constexpr const char* kSemantic = "semantic";

// Modalities with other files than an image of each frame, which LayoutKind::extra names.
inline constexpr const char* kSceneFlow = "scene_flow";
inline constexpr const char* kTracks = "tracks";

/// The folder of the images of a rig's cameras.
inline constexpr std::string_view kRigFolder = "cameras/";

/// The inertial measurements of a dataset.
inline constexpr const char* kImuFile = "imu.csv";

/// The file of a dataset with its boxes and masks, in COCO's format.
inline constexpr const char* kAnnotationFile = "annotations.json";

/// A dataset that is gathered, as far as it is kept in memory.
struct Source {
    std::filesystem::path folder;
    std::string name;  // in the names of its files; of letters, digits, '-' and '_'
    std::string card_sha256;
    std::string product_version;  // that exported it
    std::string scene;            // its name
    std::string scene_sha256;
    std::string geometry_sha256;
    std::string licenses_sha256;  // of its file LICENSES; empty: it has none
    std::size_t frames = 0;
    std::uint64_t bytes = 0;                        // of the files that are copied
    int width = 0;                                  // px
    int height = 0;                                 // px
    std::set<std::string> modalities;               // of those that can be gathered
    std::set<std::string> others;                   // modalities that only some layouts hold
    std::size_t scene_number = 0;                   // as scenesOf() numbers them
    std::shared_ptr<const ClassTable> own_classes;  // null: NYU40
    /// dataset.json, of which `card` has the conventions only. Null: read again when needed, so
    /// that memory does not grow with the number of frames.
    std::shared_ptr<const verify::StoredDataset> kept;

    [[nodiscard]] const ClassTable& classes() const {
        return own_classes ? *own_classes : ClassTable::nyu40();
    }
};

/// Which files of a dataset are gathered, and what they must have in common with the others'.
struct SourceNeeds {
    std::set<std::string> modalities;   // of each frame, where the dataset has them
    bool everything = false;            // also other images and measurements; any lens and size
    std::vector<std::string> required;  // modalities and formats without which it is refused
    std::vector<std::string> copied;    // beginnings of the names of other files
    bool mixed_lenses = false;          // datasets may have different focal lengths
    bool prove = false;                 // read all files and compare their hashes
    Status (*check)(const verify::StoredDataset& dataset) = nullptr;  // of the layout; BadInput
};

/// Reads datasets and compares each with the first.
class SourceReader {
  public:
    explicit SourceReader(SourceNeeds needs) : needs_(std::move(needs)) {}

    /// Takes what readStoredDataset() returned. Errors: BadInput where the dataset is unfinished,
    /// damaged, has no images or boxes, or does not go with the first one, naming both; Cancelled.
    [[nodiscard]] Result<Source> read(const Result<verify::StoredDataset>& dataset,
                                      const JobContext& job);

    /// Whether the last error was damage: a dataset that can be left out.
    [[nodiscard]] bool wasDamaged() const { return damaged_; }

    /// The conventions that all of them share.
    [[nodiscard]] const nlohmann::ordered_json& conventions() const { return conventions_; }

  private:
    [[nodiscard]] Result<Source> describe(const verify::StoredDataset& dataset);
    [[nodiscard]] Status checkFiles(const verify::StoredDataset& dataset, Source& source,
                                    const JobContext& job) const;
    [[nodiscard]] Status compare(const verify::StoredDataset& dataset);
    [[nodiscard]] nlohmann::ordered_json conventionsOf(const verify::StoredDataset& dataset) const;

    SourceNeeds needs_;
    bool damaged_ = false;
    std::string first_;  // the folder of the first dataset
    nlohmann::ordered_json conventions_;
    std::map<std::string, std::shared_ptr<const ClassTable>> tables_;  // by their text
};

/// Whether a name is that of an image kind that can be gathered.
[[nodiscard]] bool isModality(std::string_view name);

/// A frame's file of an image folder: "rgb/000012.png". In a folder for which isModality() is
/// false, it is a ".jpg" if dataset.json lists that.
[[nodiscard]] std::string frameFileOf(const verify::StoredDataset& dataset,
                                      std::string_view modality, std::size_t frame);

/// A frame's files of a modality: its image, the scene flow to other frames, or the tracks of the
/// clip that begins at the frame.
[[nodiscard]] std::vector<std::string> frameFilesOf(const verify::StoredDataset& dataset,
                                                    const std::string& modality, std::size_t frame);

/// A file that dataset.json lists. Error: BadInput where it does not.
[[nodiscard]] Result<SourceFile> listedFile(const verify::StoredDataset& dataset,
                                            const std::string& name);

}  // namespace dollytrack::gather
