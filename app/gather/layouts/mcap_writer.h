#pragma once

#include "app/gather/files/hashing_file_writer.h"
#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::gather {

/// Names and values of an MCAP record.
using McapMap = std::map<std::string, std::string>;

/// The definition of a message type.
struct McapSchema {
    std::string name;      // "sensor_msgs/msg/Imu"
    std::string encoding;  // of `data`: "ros2msg"
    std::string data;
};

/// Writes an MCAP file (mcap.dev/spec, major version 0) from its beginning to its end: messages in
/// uncompressed chunks with their indexes, attachments, metadata, and a summary with which readers
/// seek. Each chunk, the data section, the summary and each attachment have a CRC-32. Memory holds
/// one chunk and the indexes of all. Schemas and channels come first, then messages in the order of
/// their times. Times are in ns. Errors are CannotWrite.
class McapWriter {
  public:
    /// Creates the file and replaces one of this name. `profile`: the conventions that the messages
    /// follow, "ros2"; `library`: name and version of the program that writes the file.
    [[nodiscard]] static Result<McapWriter> create(const GuardedFolder& folder,
                                                   const std::string& name,
                                                   std::string_view profile,
                                                   std::string_view library);

    /// Returns the schema's number.
    [[nodiscard]] Result<std::uint16_t> addSchema(const McapSchema& schema);
    /// Returns the channel's number. `encoding`: of its messages, "cdr".
    [[nodiscard]] Result<std::uint16_t> addChannel(std::uint16_t schema, std::string_view topic,
                                                   std::string_view encoding,
                                                   const McapMap& metadata);
    /// A message that was recorded and published at `time_ns`.
    [[nodiscard]] Status addMessage(std::uint16_t channel, std::uint64_t time_ns,
                                    std::string_view data);
    [[nodiscard]] Status addAttachment(std::uint64_t time_ns, std::string_view name,
                                       std::string_view media_type, std::string_view data);
    [[nodiscard]] Status addMetadata(std::string_view name, const McapMap& metadata);

    /// Writes the summary and closes the file; returns its SHA-256.
    [[nodiscard]] Result<std::string> finish();

  private:
    /// A message's time and its place in the uncompressed chunk.
    using IndexEntry = std::pair<std::uint64_t, std::uint64_t>;
    struct Channel {
        std::uint64_t messages = 0;
        std::vector<IndexEntry> in_chunk;
    };

    explicit McapWriter(HashingFileWriter file) : file_(std::move(file)) {}
    [[nodiscard]] Status write(std::string_view bytes);
    [[nodiscard]] Status endChunk();
    [[nodiscard]] Status writeSummary();
    [[nodiscard]] std::string statistics() const;

    HashingFileWriter file_;
    std::uint32_t crc_ = 0;  // of the data section, then of the summary
    std::string chunk_;      // records of the current chunk
    std::uint64_t chunk_start_ns_ = 0;
    std::uint64_t start_ns_ = 0;  // of the first message
    std::uint64_t end_ns_ = 0;    // of the last message
    std::uint64_t messages_ = 0;
    std::uint32_t chunks_ = 0;
    std::uint32_t attachments_ = 0;
    std::uint32_t metadata_ = 0;
    std::uint16_t schemas_ = 0;
    std::vector<Channel> channels_;  // channel 1 is the first
    // Records of the summary.
    std::string schema_records_;
    std::string channel_records_;
    std::string chunk_indexes_;
    std::string attachment_indexes_;
    std::string metadata_indexes_;
};

}  // namespace dollytrack::gather
