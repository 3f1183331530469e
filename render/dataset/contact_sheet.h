#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/scene/class_table.h"
#include "render/dataset/modalities.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A picture on a contact sheet: an image file in a dataset's folder, and a line of text below it.
struct SheetPicture {
    std::string file;
    std::string caption;
};

/// The frames to show: evenly chosen among the key frames, which show what the trajectory is for;
/// among all frames where few are key frames. `is_key` has an entry for each.
[[nodiscard]] std::vector<int> chooseSheetFrames(const std::vector<bool>& is_key);

/// A page of small pictures of one modality, the first look at what was rendered, as a JPEG file's
/// bytes. Depth becomes grey (near is bright), ids and classes become colours. Error: BadInput for
/// a file that is gone or damaged.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeContactSheet(
    const io::GuardedFolder& folder, const std::vector<SheetPicture>& pictures,
    const Modality& modality, const ClassTable& classes, const std::string& title);

}  // namespace dollytrack::render
