#include "render/pipeline/frame_writer.h"

#include "engine/io/files/sha256.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

namespace dollytrack::render {
namespace {

// Enough waiting frames to keep the threads busy during an expensive one.
constexpr std::size_t kMaxWaiting = 4;

}  // namespace

struct FrameWriter::Impl {
    Settings settings;
    const FrameContext& context;
    OnWritten on_written;

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<FrameRecord> waiting;
    std::size_t bytes = 0;  // of waiting frames and those being written
    bool closing = false;
    std::optional<Error> error;  // of the frame with the smallest index
    int error_frame = 0;
    std::vector<std::thread> threads;

    Impl(Settings set, const FrameContext& of, OnWritten then)
        : settings(std::move(set)), context(of), on_written(std::move(then)) {
        const unsigned cores = std::max(std::thread::hardware_concurrency(), 1U);
        try {
            for (unsigned i = 0; i < std::clamp(cores, 1U, 8U); ++i) {
                threads.emplace_back([this] { work(); });
            }
        } catch (const std::exception&) {
            // Limited number of threads: continue with those that started.
        }
    }

    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            waiting.clear();
        }
        close();
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void close() {
        {
            const std::lock_guard lock(mutex);
            closing = true;
        }
        changed.notify_all();
        for (std::thread& thread : threads) thread.join();
        threads.clear();
    }

    void work() {
        while (true) {
            FrameRecord frame;
            {
                std::unique_lock lock(mutex);
                changed.wait(lock, [&] { return closing || !waiting.empty(); });
                if (waiting.empty()) return;
                frame = std::move(waiting.front());
                waiting.pop_front();
            }
            changed.notify_all();
            const std::size_t its_bytes = frame.bytes();
            process(frame);
            frame = {};
            {
                const std::lock_guard lock(mutex);
                bytes -= its_bytes;
            }
            changed.notify_all();
        }
    }

    /// Whether one more frame fits.
    [[nodiscard]] bool hasRoom(std::size_t its_bytes) const {
        return waiting.size() < kMaxWaiting &&
               (bytes == 0 || bytes + its_bytes <= settings.max_bytes);
    }

    void process(const FrameRecord& frame) {
        const Status status = tryWriting(frame);
        if (status) return;
        {
            const std::lock_guard lock(mutex);
            if (!error || frame.index < error_frame) {
                error = status.error();
                error_frame = frame.index;
            }
        }
        changed.notify_all();  // write() may be waiting for space that will not be freed
    }

    /// Converts exceptions to errors, because an exception leaving a thread ends the program.
    Status tryWriting(const FrameRecord& frame) {
        try {
            return writeFrame(frame);
        } catch (const std::exception& e) {
            return fail(ErrorCode::Failed, std::string("writing a frame failed (") + e.what() + ")",
                        "frame " + std::to_string(frame.index));
        }
    }

    Status writeFrame(const FrameRecord& frame) const {
        WrittenFrame result;
        result.index = frame.index;
        for (const Modality* modality : settings.modalities) {
            if (Status status = writeFiles(modality->encode(context, frame), result); !status) {
                return status;
            }
        }
        for (const Format* format : settings.formats) {
            if (format->encode == nullptr) continue;
            if (Status status = writeFiles(format->encode(context, frame), result); !status) {
                return status;
            }
        }
        if ((settings.needs & kNeedsMasks) != 0) {
            result.masks = objectMasks(frame.width, frame.height, frame.instance);
        }
        if ((settings.needs & kNeedsWhole) != 0) result.instances = measureInstances(frame);
        return on_written(std::move(result));
    }

    Status writeFiles(const Result<std::vector<FrameFile>>& files, WrittenFrame& result) const {
        if (!files) return tl::unexpected(files.error());
        for (const FrameFile& file : *files) {
            // Files are synced all at once before dataset.json declares the dataset complete; a
            // resumed export detects files lost in a power cut by their hashes.
            if (Status status = settings.folder.write(file.path, file.bytes, Durability::Renamed);
                !status) {
                return status;
            }
            result.sha256s[file.path] = sha256Of(file.bytes);
        }
        return {};
    }
};

FrameWriter::FrameWriter(Settings settings, const FrameContext& context, OnWritten on_written)
    : impl_(std::make_unique<Impl>(std::move(settings), context, std::move(on_written))) {}
FrameWriter::~FrameWriter() = default;
FrameWriter::FrameWriter(FrameWriter&&) noexcept = default;
FrameWriter& FrameWriter::operator=(FrameWriter&&) noexcept = default;

Status FrameWriter::write(FrameRecord frame) {
    if (impl_->threads.empty()) {
        impl_->process(frame);
        if (impl_->error) return tl::unexpected(*impl_->error);
        return {};
    }
    {
        const std::size_t bytes = frame.bytes();
        std::unique_lock lock(impl_->mutex);
        impl_->changed.wait(lock, [&] { return impl_->error || impl_->hasRoom(bytes); });
        if (impl_->error) return tl::unexpected(*impl_->error);
        impl_->bytes += bytes;
        impl_->waiting.push_back(std::move(frame));
    }
    impl_->changed.notify_all();
    return {};
}

Status FrameWriter::finish() {
    impl_->close();
    if (impl_->error) return tl::unexpected(*impl_->error);
    return {};
}

}  // namespace dollytrack::render
