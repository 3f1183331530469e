#pragma once

#include "engine/core/result.h"
#include "render/frames/frame_needs.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

struct DatasetContents;
struct FrameContext;
struct FrameFile;
struct FrameRecord;

/// A kind of image that a dataset can hold of every frame. A row of the one table from which the
/// command line, the editor's check boxes, the files and dataset.json follow.
struct Modality {
    const char* name;        // as one asks for it, and its folder in the dataset
    const char* text;        // what it is, for people
    double bytes_per_pixel;  // of its files, on the high side of furnished rooms
    bool standard;           // written where none is named
    unsigned needs;          // bits of FrameNeeds

    /// The frame's files, in the folder of the modality's name.
    Result<std::vector<FrameFile>> (*encode)(const FrameContext& context, const FrameRecord& frame);
    /// What dataset.json says of the files.
    nlohmann::ordered_json (*convention)(const DatasetContents& contents);

    bool is_picture = true;  // a PNG file a frame, which contact sheets can show
};

/// All there are; the order is that of the files.
[[nodiscard]] std::span<const Modality> modalities();

/// The modality whose files may be JPEG, see pictureEnding().
inline constexpr std::string_view kRgbSensor = "rgb_sensor";

/// Some of the table's rows, in its order.
using ModalitySet = std::vector<const Modality*>;

/// Those named, all for "all", the standard ones when none is. Error: Usage, with the closest name.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names);

/// The modality that the cameras of a rig are written as.
inline constexpr const char* kRigModality = "cameras";

/// The same for a dataset with a rig or without: a rig brings its modality, "all" does not bring it
/// without one. Error: Usage, also where it is named without a rig.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names,
                                                   bool has_rig);

[[nodiscard]] bool contains(const ModalitySet& set, std::string_view name);

}  // namespace dollytrack::render
