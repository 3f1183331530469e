#include "app/gather/files/hashing_file_writer.h"
#include "app/gather/layouts/record_bytes.h"
#include "app/gather/layouts/ros_file.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/file_descriptor.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/sha256.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <concepts>
#include <span>
#include <utility>
#include <vector>

// The format: wiki.ros.org/Bags/Format/2.0. A record is a header of named fields and data.

namespace dollytrack::gather {
namespace {

constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";
constexpr std::size_t kBagHeaderBytes = 4096;  // header and padding of the first record,
                                               // as rosbag writes it
constexpr std::size_t kBagChunkBytes = std::size_t{1} << 20U;  // a chunk ends when it has
                                                               // at least this size
constexpr std::uint32_t kIndexVersion = 1;

enum class BagOp : std::uint8_t {
    Message = 0x02,
    BagHeader = 0x03,
    Index = 0x04,
    Chunk = 0x05,
    ChunkInfo = 0x06,
    Connection = 0x07,
};

std::string field(std::string_view name, std::string_view value) {
    std::string text(name);
    text += '=';
    text += value;
    std::string bytes;
    putSized(bytes, text);
    return bytes;
}

template <std::integral Number>
std::string field(std::string_view name, Number value) {
    std::string bytes;
    put(bytes, value);
    return field(name, std::string_view(bytes));
}

/// The field `op`, the type of a record.
std::string opField(BagOp op) {
    return field("op", static_cast<std::uint8_t>(op));
}

void putRecord(std::string& bytes, std::string_view header, std::string_view data) {
    putSized(bytes, header);
    putSized(bytes, data);
}

/// Seconds in the lower 32 bits, nanoseconds in the upper ones. Time 0 becomes 1 ns
/// (ros::TIME_MIN): rosbag's C++ reader, and so `rosbag play`, skips earlier messages.
std::uint64_t bagTime(std::uint64_t time_ns) {
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    const std::uint64_t valid_ns = std::max<std::uint64_t>(time_ns, 1);
    return valid_ns / kSecond_ns | valid_ns % kSecond_ns << 32U;
}

/// The magic and the bag header record. The length is constant, so that finish() can overwrite it.
std::string bagStart(std::uint64_t index, std::uint32_t connections, std::uint32_t chunks) {
    const std::string header = opField(BagOp::BagHeader) + field("index_pos", index) +
                               field("conn_count", connections) + field("chunk_count", chunks);
    std::string bytes(kBagMagic);
    putRecord(bytes, header, std::string(kBagHeaderBytes - header.size(), ' '));
    return bytes;
}

/// Messages are in uncompressed chunks with their indexes; memory holds one chunk, and a summary of
/// each. The bag format calls a channel a connection.
class BagFile : public RosFile {
  public:
    BagFile(GuardedFolder folder, std::string name, HashingFileWriter file)
        : folder_(std::move(folder)), name_(std::move(name)), file_(std::move(file)) {}

    ros::Version version() const override { return ros::Version::Ros1; }

    Result<std::uint16_t> addTopic(const RosTopic& topic) override {
        const auto number = static_cast<std::uint16_t>(indexes_.size());
        indexes_.emplace_back();
        std::string data = field("topic", topic.name) + field("type", topic.type) +
                           field("md5sum", ros::md5Of(topic.type)) +
                           field("message_definition", ros::definitionOf(version(), topic.type));
        if (topic.is_latched) data += field("latching", "1");
        for (const auto& [name, value] : topic.metadata) data += field(name, value);
        std::string record;
        putRecord(record, headOf(BagOp::Connection, number) + field("topic", topic.name), data);
        connections_ += record;
        chunk_ += record;
        return number;
    }

    Status addMessage(std::uint16_t channel, std::uint64_t time_ns,
                      std::string_view data) override {
        end_ = bagTime(time_ns);
        if (!has_messages_) start_ = end_;
        has_messages_ = true;
        put(indexes_[channel], end_);
        put(indexes_[channel], static_cast<std::uint32_t>(chunk_.size()));
        putRecord(chunk_, headOf(BagOp::Message, channel) + field("time", end_), data);
        return chunk_.size() < kBagChunkBytes ? Status() : endChunk();
    }

    /// A bag has no attachments, so both become std_msgs/String messages.
    Status describe(std::uint64_t time_ns, const std::string& dataset_json,
                    const ClassNames& classes) override {
        const Status added = addText("/dataset", time_ns, dataset_json);
        const std::string names =
            nlohmann::json(classes).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        return added ? addText("/classes", time_ns, names) : added;
    }

    Result<std::string> finish(const JobContext& job) override {
        Status status = endChunk();
        const std::string start =
            bagStart(file_.size(), static_cast<std::uint32_t>(indexes_.size()), chunks_);
        if (status) status = file_.write(connections_);
        if (status) status = file_.write(chunk_infos_);
        if (!status) return tl::unexpected(status.error());
        // The bag header has the position of the index, known only now. It is overwritten, so the
        // file is read again for its hash.
        const Result<std::string> written = file_.finish();
        if (!written) return written;
        Result<FileDescriptor> file = folder_.openFile(name_, O_WRONLY);
        if (!file) return tl::unexpected(file.error());
        int error = writeAll(file->get(), start);
        if (error == 0) error = file->close();
        if (error != 0) return tl::unexpected(writeError(error, folder_.path() / name_));
        return hashAgain(*written, job);
    }

    Status begin() { return file_.write(bagStart(0, 0, 0)); }

  private:
    static std::string headOf(BagOp op, std::uint16_t channel) {
        return opField(op) + field("conn", std::uint32_t{channel});
    }

    /// The SHA-256 of the file. Error: CannotWrite if it is not what was written, apart from the
    /// bag header; `written` is the SHA-256 with the first header.
    Result<std::string> hashAgain(const std::string& written, const JobContext& job) const {
        const Result<InputFile> file = folder_.openInput(name_);
        if (!file) return tl::unexpected(file.error());
        const std::string first_start = bagStart(0, 0, 0);
        Sha256 hash;
        Sha256 with_first_start;
        with_first_start.add(std::string_view(first_start));
        std::vector<std::uint8_t> piece(kBagChunkBytes);
        std::uint64_t at = 0;
        while (const std::size_t got = file->read(at, piece.data(), piece.size())) {
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "gathering was cancelled");
            const std::span<const std::uint8_t> bytes(piece.data(), got);
            hash.add(bytes);
            with_first_start.add(at == 0 ? bytes.subspan(std::min(first_start.size(), got))
                                         : bytes);
            at += got;
        }
        if (with_first_start.finish() == written) return hash.finish();
        return fail(ErrorCode::CannotWrite,
                    "the file differs from what was written; check the disk and run the command "
                    "with --resume",
                    (folder_.path() / name_).string());
    }

    Status addText(const char* topic, std::uint64_t time_ns, const std::string& text) {
        const Result<std::uint16_t> channel =
            addTopic({.name = topic, .type = "std_msgs/String", .is_latched = true});
        if (!channel) return tl::unexpected(channel.error());
        return addMessage(*channel, time_ns, ros::text(version(), text));
    }

    Status endChunk() {
        if (!has_messages_) return {};
        const std::uint64_t chunk_pos = file_.size();
        std::string head;
        putSized(head, opField(BagOp::Chunk) + field("compression", "none") +
                           field("size", static_cast<std::uint32_t>(chunk_.size())));
        put(head, static_cast<std::uint32_t>(chunk_.size()));
        Status status = file_.write(head);
        if (status) status = file_.write(chunk_);

        std::string counts;  // number of messages of each connection in the chunk
        std::uint32_t channels = 0;
        for (std::size_t i = 0; i < indexes_.size(); ++i) {
            if (indexes_[i].empty()) continue;
            constexpr std::size_t kEntryBytes = sizeof(std::uint64_t) + sizeof(std::uint32_t);
            const auto count = static_cast<std::uint32_t>(indexes_[i].size() / kEntryBytes);
            put(counts, static_cast<std::uint32_t>(i));
            put(counts, count);
            ++channels;
            std::string index;
            putRecord(index,
                      headOf(BagOp::Index, static_cast<std::uint16_t>(i)) +
                          field("ver", kIndexVersion) + field("count", count),
                      indexes_[i]);
            indexes_[i].clear();
            if (status) status = file_.write(index);
        }
        putRecord(chunk_infos_,
                  opField(BagOp::ChunkInfo) + field("ver", kIndexVersion) +
                      field("chunk_pos", chunk_pos) + field("start_time", start_) +
                      field("end_time", end_) + field("count", channels),
                  counts);
        ++chunks_;
        chunk_.clear();
        has_messages_ = false;
        return status;
    }

    GuardedFolder folder_;
    std::string name_;
    HashingFileWriter file_;
    std::string chunk_;                 // records of the current chunk
    bool has_messages_ = false;         // in the current chunk
    std::uint64_t start_ = 0;           // bagTime() of the chunk's first message
    std::uint64_t end_ = 0;             // bagTime() of the last message
    std::vector<std::string> indexes_;  // by channel: times and places in the current chunk
    std::uint32_t chunks_ = 0;
    // Records at the end of the file.
    std::string connections_;
    std::string chunk_infos_;
};

}  // namespace

Result<std::unique_ptr<RosFile>> createBagFile(const GuardedFolder& folder, const std::string& name,
                                               const std::string& /*program*/) {
    Result<HashingFileWriter> file = HashingFileWriter::create(folder, name);
    if (!file) return tl::unexpected(file.error());
    auto bag = std::make_unique<BagFile>(folder, name, std::move(*file));
    if (Status begun = bag->begin(); !begun) return tl::unexpected(begun.error());
    return bag;
}

}  // namespace dollytrack::gather
