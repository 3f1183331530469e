#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/formats/mask_rle.h"
#include "render/frame_record.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::render {

/// What remains of a frame when its images are written.
struct WrittenFrame {
    std::array<std::pair<std::string, std::string>, 4> sha256s;  // relative path, hash
    std::vector<ObjectMask> masks;
};

/// Compresses and writes frames on threads of its own, while the next ones are drawn. What is
/// written does not depend on the number of threads.
class FrameWriter {
  public:
    FrameWriter(std::filesystem::path folder, const Scene& scene, int frame_count);
    /// Drops what waits, and waits for the files being written.
    ~FrameWriter();
    FrameWriter(FrameWriter&&) noexcept;
    FrameWriter& operator=(FrameWriter&&) noexcept;

    /// Hands over a frame; waits while too many are on their way. The first error of any earlier
    /// frame.
    [[nodiscard]] Status write(FrameRecord frame);

    /// Waits for all frames; one entry a frame, by index.
    [[nodiscard]] Result<std::vector<WrittenFrame>> finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
