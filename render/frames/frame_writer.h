#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/modalities.h"
#include "render/formats/formats.h"
#include "render/formats/labels/mask_rle.h"
#include "render/frames/frame_context.h"
#include "render/frames/frame_record.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

/// What remains of a frame when its images are written.
struct WrittenFrame {
    int index = 0;
    std::map<std::string, std::string> sha256s;  // by relative path
    std::vector<ObjectMask> masks;               // where they are wanted
    std::vector<InstanceInFrame> instances;      // where they are wanted
};

/// Compresses and writes frames on threads of its own, while the next ones are drawn; in write()
/// itself where the system gives it no thread. What is written does not depend on their number.
class FrameWriter {
  public:
    struct Settings {
        io::GuardedFolder folder;
        ModalitySet modalities;
        FormatSet formats;
        unsigned needs = 0;  // bits of FrameNeeds
        // Of the frames on their way, unless one alone is larger. What encoding takes beside is no
        // more than that: 2 GiB together, whatever the resolution and the number of threads.
        std::size_t max_bytes = 1ULL << 30U;
    };
    /// Called on any thread when a frame's files are complete; its error counts as the frame's.
    using OnWritten = std::function<Status(WrittenFrame)>;

    /// Keeps a reference to the context.
    FrameWriter(Settings settings, const FrameContext& context, OnWritten on_written);
    /// Drops what waits, and waits for the files being written.
    ~FrameWriter();
    FrameWriter(FrameWriter&&) noexcept;
    FrameWriter& operator=(FrameWriter&&) noexcept;

    /// Hands over a frame; waits while too many are on their way. The first error of any earlier
    /// frame.
    [[nodiscard]] Status write(FrameRecord frame);

    /// Waits for all frames.
    [[nodiscard]] Status finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
