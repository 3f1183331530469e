#pragma once

#include "engine/core/result.h"
#include "render/frame_record.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A page of small pictures from a dataset, each with a line of text: the first look at what was
/// rendered. Evenly chosen among the key frames, which show what the trajectory is for; among all
/// frames where few are key frames.
class ContactSheet {
  public:
    /// For a dataset of frames of this size; `is_key` has an entry for each.
    ContactSheet(const std::vector<bool>& is_key, int width, int height);
    ~ContactSheet();
    ContactSheet(ContactSheet&&) noexcept;
    ContactSheet& operator=(ContactSheet&&) noexcept;

    /// Whether this frame is one of the chosen.
    [[nodiscard]] bool wants(int index) const;
    void add(const FrameRecord& frame, const std::string& caption);

    /// The page as a JPEG file's bytes.
    [[nodiscard]] Result<std::vector<std::uint8_t>> encode(const std::string& title) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
