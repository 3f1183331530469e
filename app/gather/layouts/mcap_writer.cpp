#include "app/gather/layouts/mcap_writer.h"

#include "app/gather/layouts/record_bytes.h"

#include <zlib.h>

#include <array>

namespace dollytrack::gather {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;  // from which on a chunk is ended

enum class Opcode : std::uint8_t {
    Header = 0x01,
    Footer = 0x02,
    Schema = 0x03,
    Channel = 0x04,
    Message = 0x05,
    Chunk = 0x06,
    MessageIndex = 0x07,
    ChunkIndex = 0x08,
    Attachment = 0x09,
    AttachmentIndex = 0x0A,
    Statistics = 0x0B,
    Metadata = 0x0C,
    MetadataIndex = 0x0D,
    SummaryOffset = 0x0E,
    DataEnd = 0x0F,
};

std::uint32_t crcOf(std::string_view bytes, std::uint32_t before = 0) {
    return static_cast<std::uint32_t>(
        crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void putMap(std::string& bytes, const McapMap& map) {
    std::string pairs;
    for (const auto& [key, value] : map) {
        putSized(pairs, key);
        putSized(pairs, value);
    }
    putSized(bytes, pairs);
}

/// Opcode and length of a record, whose content follows.
std::string headOf(Opcode opcode, std::uint64_t content_bytes) {
    std::string head(1, static_cast<char>(opcode));
    put(head, content_bytes);
    return head;
}

std::string recordOf(Opcode opcode, std::string_view content) {
    return headOf(opcode, content.size()).append(content);
}

}  // namespace

Result<McapWriter> McapWriter::create(const GuardedFolder& folder, const std::string& name,
                                      std::string_view profile, std::string_view library) {
    Result<HashingFileWriter> file = HashingFileWriter::create(folder, name);
    if (!file) return tl::unexpected(file.error());
    McapWriter writer(std::move(*file));
    std::string header;
    putSized(header, profile);
    putSized(header, library);
    const Status written = writer.write(std::string(kMagic) + recordOf(Opcode::Header, header));
    if (!written) return tl::unexpected(written.error());
    return writer;
}

Status McapWriter::write(std::string_view bytes) {
    crc_ = crcOf(bytes, crc_);
    return file_.write(bytes);
}

Result<std::uint16_t> McapWriter::addSchema(const McapSchema& schema) {
    std::string content;
    put(content, ++schemas_);
    putSized(content, schema.name);
    putSized(content, schema.encoding);
    putSized(content, schema.data);
    const std::string record = recordOf(Opcode::Schema, content);
    schema_records_ += record;
    if (Status written = write(record); !written) return tl::unexpected(written.error());
    return schemas_;
}

Result<std::uint16_t> McapWriter::addChannel(std::uint16_t schema, std::string_view topic,
                                             std::string_view encoding, const McapMap& metadata) {
    channels_.emplace_back();
    const auto number = static_cast<std::uint16_t>(channels_.size());
    std::string content;
    put(content, number);
    put(content, schema);
    putSized(content, topic);
    putSized(content, encoding);
    putMap(content, metadata);
    const std::string record = recordOf(Opcode::Channel, content);
    channel_records_ += record;
    if (Status written = write(record); !written) return tl::unexpected(written.error());
    return number;
}

Status McapWriter::addMessage(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) {
    Channel& of = channels_[channel - 1U];
    if (messages_ == 0) start_ns_ = time_ns;
    if (chunk_.empty()) chunk_start_ns_ = time_ns;
    end_ns_ = time_ns;
    of.in_chunk.emplace_back(time_ns, chunk_.size());
    std::string head;
    put(head, channel);
    put(head, static_cast<std::uint32_t>(of.messages));
    put(head, time_ns);  // recorded
    put(head, time_ns);  // published
    chunk_ += headOf(Opcode::Message, head.size() + data.size());
    chunk_ += head;
    chunk_ += data;
    ++of.messages;
    ++messages_;
    return chunk_.size() < kChunkBytes ? Status() : endChunk();
}

Status McapWriter::endChunk() {
    if (chunk_.empty()) return {};
    std::string head;
    put(head, chunk_start_ns_);
    put(head, end_ns_);
    put(head, std::uint64_t{chunk_.size()});  // uncompressed
    put(head, crcOf(chunk_));
    putSized(head, "");  // no compression
    put(head, std::uint64_t{chunk_.size()});
    const std::uint64_t start = file_.size();
    Status status = write(headOf(Opcode::Chunk, head.size() + chunk_.size()) + head);
    if (status) status = write(chunk_);
    const std::uint64_t end = file_.size();

    std::string places;  // of the message indexes, by channel
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        std::vector<IndexEntry>& entries = channels_[i].in_chunk;
        if (entries.empty()) continue;
        const auto channel = static_cast<std::uint16_t>(i + 1);
        put(places, channel);
        put(places, file_.size());
        std::string pairs;
        for (const auto& [time_ns, offset] : entries) {
            put(pairs, time_ns);
            put(pairs, offset);
        }
        entries.clear();
        std::string index;
        put(index, channel);
        putSized(index, pairs);
        if (status) status = write(recordOf(Opcode::MessageIndex, index));
    }

    std::string index;
    put(index, chunk_start_ns_);
    put(index, end_ns_);
    put(index, start);
    put(index, end - start);
    putSized(index, places);
    put(index, file_.size() - end);
    putSized(index, "");
    put(index, std::uint64_t{chunk_.size()});  // compressed
    put(index, std::uint64_t{chunk_.size()});  // uncompressed
    chunk_indexes_ += recordOf(Opcode::ChunkIndex, index);
    ++chunks_;
    chunk_.clear();
    return status;
}

Status McapWriter::addAttachment(std::uint64_t time_ns, std::string_view name,
                                 std::string_view media_type, std::string_view data) {
    std::string head;
    put(head, time_ns);  // recorded
    put(head, time_ns);  // created
    putSized(head, name);
    putSized(head, media_type);
    put(head, std::uint64_t{data.size()});
    std::string crc;
    put(crc, crcOf(data, crcOf(head)));
    const std::uint64_t start = file_.size();
    Status status =
        write(headOf(Opcode::Attachment, head.size() + data.size() + crc.size()) + head);
    if (status) status = write(data);
    if (status) status = write(crc);

    std::string index;
    put(index, start);
    put(index, file_.size() - start);
    put(index, time_ns);
    put(index, time_ns);
    put(index, std::uint64_t{data.size()});
    putSized(index, name);
    putSized(index, media_type);
    attachment_indexes_ += recordOf(Opcode::AttachmentIndex, index);
    ++attachments_;
    return status;
}

Status McapWriter::addMetadata(std::string_view name, const McapMap& metadata) {
    std::string content;
    putSized(content, name);
    putMap(content, metadata);
    const std::string record = recordOf(Opcode::Metadata, content);
    std::string index;
    put(index, file_.size());
    put(index, std::uint64_t{record.size()});
    putSized(index, name);
    metadata_indexes_ += recordOf(Opcode::MetadataIndex, index);
    ++metadata_;
    return write(record);
}

std::string McapWriter::statistics() const {
    std::string content;
    put(content, messages_);
    put(content, schemas_);
    put(content, static_cast<std::uint32_t>(channels_.size()));
    put(content, attachments_);
    put(content, metadata_);
    put(content, chunks_);
    put(content, start_ns_);
    put(content, end_ns_);
    std::string counts;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        put(counts, static_cast<std::uint16_t>(i + 1));
        put(counts, channels_[i].messages);
    }
    putSized(content, counts);
    return recordOf(Opcode::Statistics, content);
}

Status McapWriter::writeSummary() {
    crc_ = 0;
    const std::uint64_t start = file_.size();
    const std::string statistics_record = statistics();
    const std::array<std::pair<Opcode, const std::string*>, 6> groups = {{
        {Opcode::Schema, &schema_records_},
        {Opcode::Channel, &channel_records_},
        {Opcode::Statistics, &statistics_record},
        {Opcode::ChunkIndex, &chunk_indexes_},
        {Opcode::AttachmentIndex, &attachment_indexes_},
        {Opcode::MetadataIndex, &metadata_indexes_},
    }};
    std::string offsets;
    for (const auto& [opcode, records] : groups) {
        if (records->empty()) continue;
        std::string content;
        put(content, static_cast<std::uint8_t>(opcode));
        put(content, file_.size());
        put(content, std::uint64_t{records->size()});
        offsets += recordOf(Opcode::SummaryOffset, content);
        if (Status written = write(*records); !written) return written;
    }
    const std::uint64_t offsets_start = file_.size();
    if (Status written = write(offsets); !written) return written;

    constexpr std::uint64_t kFooterBytes = 8 + 8 + 4;
    std::string footer = headOf(Opcode::Footer, kFooterBytes);
    put(footer, start);
    put(footer, offsets_start);
    put(footer, crcOf(footer, crc_));  // of the summary and the footer up to here
    return write(footer.append(kMagic));
}

Result<std::string> McapWriter::finish() {
    Status status = endChunk();
    std::string crc;
    put(crc, crc_);
    if (status) status = write(recordOf(Opcode::DataEnd, crc));
    if (status) status = writeSummary();
    if (!status) return tl::unexpected(status.error());
    return file_.finish();
}

}  // namespace dollytrack::gather
