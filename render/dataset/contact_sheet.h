#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/scene/class_table.h"
#include "render/dataset/contents/modality.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::render {

/// An entry of a contact sheet: an image file in the dataset folder and its caption.
struct SheetPicture {
    std::string file;
    std::string caption;
};

/// At most 24 evenly spaced frames: among the key frames if there are at least 12, else among all.
/// `is_key` has one entry per frame.
[[nodiscard]] std::vector<int> chooseSheetFrames(const std::vector<bool>& is_key);

/// Encodes a JPEG page of thumbnails of one modality. Depth becomes grey (near is bright), ids and
/// classes become colours. Returns BadInput if a file is missing or damaged.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeContactSheet(
    const GuardedFolder& folder, const std::vector<SheetPicture>& pictures,
    const Modality& modality, const ClassTable& classes, const std::string& title);

}  // namespace dollytrack::render
