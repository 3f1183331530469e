#include "render/frame_writer.h"

#include "engine/io/durable_file.h"
#include "engine/io/png_writer.h"
#include "engine/io/sha256.h"
#include "render/dataset_folder.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

namespace dollytrack::render {
namespace {

// Enough to keep the threads busy over an expensive frame; each holds some 5 MB at 640 x 480.
constexpr std::size_t kMaxWaiting = 4;

std::span<const std::uint8_t> bytesOf(const std::vector<std::uint16_t>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), 2 * values.size()};
}

}  // namespace

struct FrameWriter::Impl {
    std::filesystem::path folder;
    const Scene& scene;
    std::vector<WrittenFrame> written;

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<FrameRecord> waiting;
    bool closing = false;
    std::optional<Error> error;  // the first one, in the order of frames
    int error_frame = 0;
    std::vector<std::thread> threads;

    Impl(std::filesystem::path out, const Scene& of, int frame_count)
        : folder(std::move(out)), scene(of), written(static_cast<std::size_t>(frame_count)) {
        const unsigned cores = std::max(std::thread::hardware_concurrency(), 1U);
        try {
            for (unsigned i = 0; i < std::clamp(cores, 1U, 8U); ++i) {
                threads.emplace_back([this] { work(); });
            }
        } catch (...) {
            close();  // those already running
            throw;
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
            const Status status = tryWriting(frame);
            if (status) continue;
            const std::lock_guard lock(mutex);
            if (!error || frame.index < error_frame) {
                error = status.error();
                error_frame = frame.index;
            }
        }
    }

    /// An exception must not leave a thread: it would end the program.
    Status tryWriting(FrameRecord& frame) {
        try {
            return writeFrame(frame);
        } catch (const std::exception& e) {
            return fail(ErrorCode::Failed, std::string("writing a frame failed (") + e.what() + ")",
                        "frame " + std::to_string(frame.index));
        }
    }

    Status writeFrame(FrameRecord& frame) {
        frame.labelClasses(scene);
        const std::vector<std::uint16_t> depth = depthInMillimetres(frame.depth_m);
        struct Image {
            const char* name;
            io::PngFormat format;
            std::span<const std::uint8_t> pixels;
        };
        const std::array<Image, 4> images = {{
            {"rgb", io::PngFormat::Rgb8, frame.rgb},
            {"depth", io::PngFormat::Gray16, bytesOf(depth)},
            {"instance", io::PngFormat::Gray16, bytesOf(frame.instance)},
            {"semantic", io::PngFormat::Gray8, frame.semantic},
        }};
        WrittenFrame& result = written[static_cast<std::size_t>(frame.index)];
        for (std::size_t i = 0; i < images.size(); ++i) {
            const auto png =
                io::encodePng(frame.width, frame.height, images[i].format, images[i].pixels);
            if (!png) return tl::unexpected(png.error());
            const std::string file = frameFile(images[i].name, frame.index);
            // The folder is synced once, before dataset.json says that it is complete.
            if (Status status = io::writeWhole(folder / file, *png, io::Durability::Renamed);
                !status) {
                return status;
            }
            result.sha256s[i] = {file, io::sha256Of(*png)};
        }
        result.masks = objectMasks(frame.width, frame.height, frame.instance);
        return {};
    }
};

FrameWriter::FrameWriter(std::filesystem::path folder, const Scene& scene, int frame_count)
    : impl_(std::make_unique<Impl>(std::move(folder), scene, frame_count)) {}
FrameWriter::~FrameWriter() = default;
FrameWriter::FrameWriter(FrameWriter&&) noexcept = default;
FrameWriter& FrameWriter::operator=(FrameWriter&&) noexcept = default;

Status FrameWriter::write(FrameRecord frame) {
    {
        std::unique_lock lock(impl_->mutex);
        impl_->changed.wait(lock,
                            [&] { return impl_->error || impl_->waiting.size() < kMaxWaiting; });
        if (impl_->error) return tl::unexpected(*impl_->error);
        impl_->waiting.push_back(std::move(frame));
    }
    impl_->changed.notify_all();
    return {};
}

Result<std::vector<WrittenFrame>> FrameWriter::finish() {
    impl_->close();
    if (impl_->error) return tl::unexpected(*impl_->error);
    return std::move(impl_->written);
}

}  // namespace dollytrack::render
