#pragma once

#include "app/gather/layouts/layout.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::gather {

/// A layout of numbered files (shards) that each hold as many frames as the limits allow. `Frame`
/// is a frame's content between reading and writing; later frames reuse its memory.
/// One thread writes frames while the others read the next ones.
template <class Frame>
class ShardLayout : public Layout {
  public:
    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        shard_ = 0;
        frames_to_skip_ = 0;
        return passFinished();
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        for (; frames_to_skip_ > 0 && begin < end; ++begin, --frames_to_skip_) skip(source, begin);
        const std::size_t count = end - begin;
        if (being_read_.size() < count) being_read_.resize(count);
        std::vector<Status> have_read(count);
        Status appended;
        parallelFor(count + 1, [&](std::size_t i) {
            if (i == 0) {
                appended = appendWaiting();
            } else if (!input_.job.cancelled()) {
                have_read[i - 1] = read(source, begin + i - 1, being_read_[i - 1]);
            }
        });
        if (!appended || input_.job.cancelled()) return appended;
        for (const Status& one : have_read) {
            if (!one) return one;
        }
        std::swap(waiting_, being_read_);
        waiting_count_ = count;
        return {};
    }

    Status endPart() override {
        if (Status appended = appendWaiting(); !appended) return appended;
        return file_ ? endShard() : Status();
    }

  protected:
    explicit ShardLayout(LayoutInput input) : input_(std::move(input)) {}

    /// The name of a shard while the part is written.
    [[nodiscard]] virtual std::string shardName(std::size_t shard) const = 0;
    /// Called for a frame in a shard that an earlier run finished.
    virtual void skip(const OpenedSource& /*source*/, std::size_t /*frame*/) {}
    /// Replaces the content of `into`. Called by several threads at once.
    [[nodiscard]] virtual Status read(const OpenedSource& source, std::size_t frame,
                                      Frame& into) const = 0;
    /// The size that the open shard has at most, if it ends after one more frame.
    [[nodiscard]] virtual std::uint64_t bytesWith(const Frame& frame) const = 0;
    [[nodiscard]] virtual Status beginFile() { return {}; }
    [[nodiscard]] virtual Status append(const Frame& frame) = 0;
    /// Writes what follows the last frame.
    [[nodiscard]] virtual Status endFile() = 0;
    /// Called for each complete shard, in order.
    [[nodiscard]] virtual Status keep(const FinishedShard& shard) {
        return input_.files.list(shard.name, shard.sha256);
    }

    [[nodiscard]] LayoutInput& input() { return input_; }
    [[nodiscard]] const LayoutInput& input() const { return input_; }
    [[nodiscard]] const std::string& part() const { return part_; }
    /// The open shard.
    [[nodiscard]] HashingFileWriter& file() { return *file_; }
    [[nodiscard]] const HashingFileWriter& file() const { return *file_; }

  private:
    /// Keeps the shards of an interrupted run up to the first missing or damaged one.
    Status passFinished() {
        for (;; ++shard_) {
            const std::string name = shardName(shard_);
            const auto done = std::ranges::find(input_.finished, name, &FinishedShard::name);
            if (done == input_.finished.end()) return {};
            if (sha256Within(input_.files.folder(), name, input_.job) != done->sha256) return {};
            frames_to_skip_ += done->frames;
            if (Status status = keep(*done); !status) return status;
        }
    }

    Status appendWaiting() {
        Status status;
        for (std::size_t i = 0; i < waiting_count_; ++i) {
            if (status) status = appendToShard(waiting_[i]);
        }
        waiting_count_ = 0;
        return status;
    }

    Status appendToShard(const Frame& frame) {
        const ShardLimits& limits = input_.shards;
        if (file_ &&
            (bytesWith(frame) > limits.bytes || (limits.frames > 0 && frames_ >= limits.frames))) {
            if (Status status = endShard(); !status) return status;
        }
        if (!file_) {
            Result<HashingFileWriter> file =
                HashingFileWriter::create(input_.files.folder(), shardName(shard_));
            if (!file) return tl::unexpected(file.error());
            file_.emplace(std::move(*file));
            frames_ = 0;
            if (Status status = beginFile(); !status) return status;
        }
        ++frames_;
        return append(frame);
    }

    Status endShard() {
        if (Status status = endFile(); !status) return status;
        Result<std::string> sha256 = file_->finish();
        if (!sha256) return tl::unexpected(sha256.error());
        file_.reset();
        const FinishedShard shard{shardName(shard_), frames_, std::move(*sha256)};
        ++shard_;
        if (Status status = keep(shard); !status) return status;
        return input_.on_shard(shard);
    }

    LayoutInput input_;
    std::string part_;
    std::size_t shard_ = 0;           // number within the part
    std::size_t frames_ = 0;          // in the open shard
    std::size_t frames_to_skip_ = 0;  // frames in finished shards, not written again
    std::vector<Frame> waiting_;      // begins with frames that are not written yet
    std::size_t waiting_count_ = 0;
    std::vector<Frame> being_read_;
    std::optional<HashingFileWriter> file_;
};

}  // namespace dollytrack::gather
