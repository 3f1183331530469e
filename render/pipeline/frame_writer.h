#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/contents/format.h"
#include "render/dataset/contents/frame_context.h"
#include "render/dataset/contents/modality.h"
#include "render/frames/frame_record.h"
#include "render/frames/mask_rle.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Results of a frame whose files are written.
struct WrittenFrame {
    int index = 0;
    std::map<std::string, std::string> sha256s;  // by path relative to the dataset folder
    std::vector<ObjectMask> masks;               // only with kNeedsMasks
    std::vector<InstanceInFrame> instances;      // only with kNeedsWhole
};

/// Compresses and writes frames on its own threads while the next frames are drawn. If the system
/// grants no thread, write() does the work itself. Output does not depend on the number of threads.
class FrameWriter {
  public:
    struct Settings {
        GuardedFolder folder;
        ModalitySet modalities;
        FormatSet formats;
        unsigned needs = 0;  // bits of FrameNeeds
        // Limit for all frames in memory, unless a single one is larger. Encoding takes at most as
        // much again, so the total is 2 GiB for any resolution and number of threads.
        std::size_t max_bytes = 1ULL << 30U;
    };
    /// Called on any thread when a frame's files are complete. An error it returns counts as the
    /// frame's.
    using OnWritten = std::function<Status(WrittenFrame)>;

    /// Keeps references to `context`.
    FrameWriter(Settings settings, const FrameContext& context, OnWritten on_written);
    /// Discards waiting frames and waits for those being written.
    ~FrameWriter();
    FrameWriter(FrameWriter&&) noexcept;
    FrameWriter& operator=(FrameWriter&&) noexcept;

    /// Queues a frame; blocks while too many are in memory. Returns the first error of earlier
    /// frames.
    [[nodiscard]] Status write(FrameRecord frame);

    /// Waits for all frames. Returns their first error.
    [[nodiscard]] Status finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
