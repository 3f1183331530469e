#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/frame_record.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// A kind of image that a dataset can hold of every frame. A row of the one table from which the
/// command line, the editor's check boxes, the files and dataset.json follow.
struct Modality {
    const char* name;        // as one asks for it, and its folder in the dataset
    const char* text;        // what it is, for people
    double bytes_per_pixel;  // of a file, on the high side of furnished rooms

    /// The bytes of the file.
    Result<std::vector<std::uint8_t>> (*encode)(const Scene& scene, const FrameRecord& frame);
    /// What dataset.json says of the files.
    nlohmann::ordered_json (*convention)();
};

/// All there are; the order is that of the files.
[[nodiscard]] std::span<const Modality> modalities();

/// Some of the table's rows, in its order.
using ModalitySet = std::vector<const Modality*>;

/// Those named; all when none is. Error: Usage, with the closest name.
[[nodiscard]] Result<ModalitySet> chooseModalities(const std::vector<std::string>& names);

[[nodiscard]] bool contains(const ModalitySet& set, std::string_view name);

/// "rgb/000012.png"
[[nodiscard]] std::string frameFile(const std::string& modality, int index);

}  // namespace dollytrack::render
