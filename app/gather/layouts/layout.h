#pragma once

#include "app/gather/output/output_files.h"
#include "app/gather/output/output_folder.h"
#include "app/gather/sources/opened_source.h"
#include "app/gather/sources/scene_split.h"
#include "engine/core/result.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::gather {

/// How a shard (a tar or Parquet file) is limited; whichever comes first.
struct ShardLimits {
    std::uint64_t bytes = 0;
    std::size_t frames = 0;  // 0: any number
};

/// What all layouts are written with.
struct LayoutInput {
    OutputFiles& files;
    const ClassUnion& classes;
    std::set<std::string> modalities;  // of each frame
    ShardLimits shards;
    std::vector<FinishedShard> finished;  // shards of an earlier run
    std::function<Status(const FinishedShard&)> on_shard;
    JobContext job;
};

/// How a gathered dataset's files are arranged. The parts are written one after the other, each
/// from the first frame to the last.
class Layout {
  public:
    virtual ~Layout() = default;
    [[nodiscard]] virtual Status beginPart(PartIndex part) = 0;
    /// Frames `begin` to `end` (not included) of a dataset.
    [[nodiscard]] virtual Status add(const OpenedSource& source, std::size_t begin,
                                     std::size_t end) = 0;
    [[nodiscard]] virtual Status endPart() = 0;
    /// After the last part.
    [[nodiscard]] virtual Status finish(std::span<const PartIndex> /*parts*/) { return {}; }
};

/// For LayoutKind::make.
template <class Kind>
std::unique_ptr<Layout> makeLayout(LayoutInput input) {
    return std::make_unique<Kind>(std::move(input));
}

/// Which files of the datasets a layout holds.
enum class LayoutContent {
    Copied,      // only the files that LayoutKind::copied names
    Colour,      // the colour images
    Shared,      // also depth, instance and class images, if all datasets have them
    Everything,  // all of a dataset's PNG and JPEG images, and inertial measurements
};

// Values of LayoutKind::labels.
inline constexpr const char* kBoxes =
    "a box of each visible target object; walls, floors and excluded objects have none";
inline constexpr const char* kBoxesAndMasks =
    "a box and a mask of each visible target object; walls, floors and excluded objects have none";
inline constexpr std::array<const char*, 1> kBoxTasks = {"object-detection"};
inline constexpr std::array<const char*, 2> kMaskTasks = {"object-detection", "image-segmentation"};

/// A layout by its name on the command line.
struct LayoutKind {
    const char* name;
    const char* text;  // what it is, for people
    LayoutContent content;
    std::span<const char* const> tasks;  // Hugging Face's names of what can be trained with it
    std::unique_ptr<Layout> (*make)(LayoutInput input);
    const char* labels;       // after "frames with", in the dataset's README.md
    const char* how_to_read;  // in the dataset's README.md
    /// What follows how_to_read about the gathered modalities; null: nothing.
    std::string (*how_to_read_modalities)(const std::set<std::string>& modalities) = nullptr;
    /// `path` of a part in the README's header, as in "{}-*.tar"; null: Hugging Face has no reader.
    const char* data_files;
    std::uint64_t shard_bytes = 1'000'000'000;   // the default limit
    std::span<const char* const> required = {};  // modalities and formats of each dataset
    std::span<const char* const> copied = {};    // beginnings of names of files besides images
    /// Modalities besides images that it holds if all datasets have them: kSceneFlow, kTracks.
    std::span<const char* const> extra = {};
    /// Checks a dataset for what only this layout cannot hold, before anything is written;
    /// BadInput.
    Status (*check)(const verify::StoredDataset& dataset) = nullptr;
};

extern const LayoutKind kYoloLayout;
extern const LayoutKind kCocoLayout;
extern const LayoutKind kImageFolderLayout;
extern const LayoutKind kWebDatasetLayout;
extern const LayoutKind kParquetLayout;
extern const LayoutKind kBopLayout;
extern const LayoutKind kTartanAirLayout;
extern const LayoutKind kMcapLayout;
extern const LayoutKind kRosbagLayout;

[[nodiscard]] std::span<const LayoutKind* const> layouts();

/// "`depth.png` and `instance.png` have the same pixels as the colour image. " with the file
/// extension or an empty text as `ending`; empty if there are neither depth, instance nor class
/// images.
[[nodiscard]] std::string labelImagesText(const std::set<std::string>& modalities,
                                          std::string_view ending);

}  // namespace dollytrack::gather
