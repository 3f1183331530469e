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

/// An image kind that a dataset can hold for every frame; a row of the table from which the command
/// line, the editor's check boxes, the files and dataset.json are derived.
struct Modality {
    const char* name;        // name on the command line, and folder in the dataset
    const char* text;        // description for users
    double bytes_per_pixel;  // typical file size, on the high side for furnished rooms
    bool standard;           // written if no modality is named
    unsigned needs;          // bits of FrameNeeds

    /// Encodes the frame's files, in the folder named after the modality.
    Result<std::vector<FrameFile>> (*encode)(const FrameContext& context, const FrameRecord& frame);
    /// Description of the files for dataset.json.
    nlohmann::ordered_json (*convention)(const DatasetContents& contents);

    bool is_picture = true;  // one PNG file per frame, usable for contact sheets
};

/// The whole table, in the order in which files are written.
[[nodiscard]] std::span<const Modality> modalities();

/// The modality whose files may be JPEG; see pictureEnding().
inline constexpr std::string_view kRgbSensor = "rgb_sensor";

/// A selection of the table's rows, in its order.
using ModalitySet = std::vector<const Modality*>;

/// Selects by name: all for "all", the standard ones if `names` is empty. Returns Usage, suggesting
/// the closest name, for an unknown one.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names);

/// The modality of a rig's cameras.
inline constexpr const char* kRigModality = "cameras";

/// The same with regard to a rig: kRigModality is included exactly if there is a rig. Returns Usage
/// also if it is named without a rig.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names,
                                                   bool has_rig);

[[nodiscard]] bool contains(const ModalitySet& set, std::string_view name);

}  // namespace dollytrack::render
