#pragma once

#include "engine/core/result.h"
#include "render/dataset/contents/content_group.h"
#include "render/frames/frame_needs.h"

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <limits>
#include <string_view>
#include <vector>

namespace dollytrack::render {

struct DatasetContents;
struct FrameContext;
struct FrameFile;
struct FrameRecord;

/// An image kind that a dataset can hold for every frame; a row of the table in
/// encoders/modalities.h, from which the command line, the editor's check boxes, the files and
/// dataset.json are derived.
struct Modality {
    const char* name;  // name on the command line, and folder in the dataset
    const char* text;  // description for users
    ContentGroup group;
    double bytes_per_pixel;  // typical file size, on the high side for furnished rooms
    bool standard;           // written if no modality is named
    unsigned needs;          // bits of FrameNeeds

    /// Encodes the frame's files, in the folder named after the modality.
    Result<std::vector<FrameFile>> (*encode)(const FrameContext& context, const FrameRecord& frame);
    /// Description of the files for dataset.json.
    nlohmann::ordered_json (*convention)(const DatasetContents& contents);

    bool is_picture = true;          // one PNG file per frame, usable for contact sheets
    bool per_flow_distance = false;  // its files are for each of the flow distances
    /// Limit of a frame's bytes; infinite if they grow with the image.
    double most_bytes = std::numeric_limits<double>::infinity();
};

/// The modality whose files may be JPEG; see pictureEnding().
inline constexpr std::string_view kRgbSensor = "rgb_sensor";

/// The modality of a rig's cameras.
inline constexpr const char* kRigModality = "cameras";

/// A selection of modalities, in the order of the table.
using ModalitySet = std::vector<const Modality*>;

[[nodiscard]] inline bool contains(const ModalitySet& set, std::string_view name) {
    return std::any_of(set.begin(), set.end(), [&](const Modality* m) { return m->name == name; });
}

}  // namespace dollytrack::render
