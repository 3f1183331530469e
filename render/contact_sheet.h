#pragma once

#include "engine/core/result.h"
#include "render/frame_record.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A page of small pictures, evenly chosen from a dataset, each with a line of text: the first
/// look at what was rendered.
class ContactSheet {
  public:
    /// For a dataset of `frame_count` frames of this size.
    ContactSheet(int frame_count, int width, int height);
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
