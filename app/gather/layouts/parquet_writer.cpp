#include "app/gather/layouts/parquet_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace dollytrack::gather {
namespace {

using Kind = ParquetField::Kind;

constexpr std::string_view kParquetMagic = "PAR1";
constexpr std::int64_t kGroupRows = 100;
constexpr std::size_t kGroupBytes = 32'000'000;

// Numbers of the Parquet format (parquet.thrift).
constexpr int kNoRepetition = -1;  // of the schema itself
constexpr int kRequired = 0;
constexpr int kRepeated = 2;
constexpr int kPlainEncoding = 0;
constexpr int kRunLengthEncoding = 3;

/// The Parquet type of a value.
int typeOf(Kind kind) {
    switch (kind) {
        case Kind::Int32:
            return 1;
        case Kind::Int64:
            return 2;
        case Kind::Float:
            return 4;
        case Kind::Double:
            return 5;
        default:
            return 6;
    }
}

void appendVarint(std::string& bytes, std::uint64_t value) {
    for (; value >= 0x80U; value >>= 7U) bytes += static_cast<char>(value | 0x80U);
    bytes += static_cast<char>(value);
}

/// Signed integers are mapped to unsigned ones: 0, -1, 1, -2 ... to 0, 1, 2, 3 ...
void appendZigzag(std::string& bytes, std::int64_t value) {
    appendVarint(bytes, (static_cast<std::uint64_t>(value) << 1U) ^
                            static_cast<std::uint64_t>(value >> 63U));
}

void appendText(std::string& bytes, std::string_view text) {
    appendVarint(bytes, text.size());
    bytes += text;
}

template <class Number>
void appendLittleEndian(std::string& bytes, Number value) {
    std::array<char, sizeof(Number)> raw = {};
    std::memcpy(raw.data(), &value, sizeof(Number));
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
}

/// A struct in Thrift's compact protocol. Fields are added in the order of their ids.
class ThriftStruct {
  public:
    enum Type : std::uint8_t { kInt32 = 5, kInt64 = 6, kBinary = 8, kList = 9, kStruct = 12 };

    ThriftStruct& integer(int id, std::int64_t value, Type type = kInt32) {
        begin(id, type);
        appendZigzag(bytes_, value);
        return *this;
    }
    ThriftStruct& text(int id, std::string_view value) {
        begin(id, kBinary);
        appendText(bytes_, value);
        return *this;
    }
    ThriftStruct& child(int id, const ThriftStruct& value) {
        begin(id, kStruct);
        bytes_ += value.bytes();
        return *this;
    }
    /// `elements` are already encoded, one after the other.
    ThriftStruct& list(int id, Type type, std::size_t count, std::string_view elements) {
        begin(id, kList);
        constexpr std::size_t kShort = 15;
        bytes_ += static_cast<char>((std::min(count, kShort) << 4U) | type);
        if (count >= kShort) appendVarint(bytes_, count);
        bytes_ += elements;
        return *this;
    }
    [[nodiscard]] std::string bytes() const { return bytes_ + '\0'; }

  private:
    void begin(int id, Type type) {
        bytes_ += static_cast<char>(((id - last_id_) << 4) | type);
        last_id_ = id;
    }

    std::string bytes_;
    int last_id_ = 0;
};

/// SchemaElement.
std::string schemaElement(const ParquetField& field, int repetition, std::size_t children) {
    constexpr int kUtf8 = 0;
    constexpr int kListType = 3;
    ThriftStruct element;
    const bool is_value = children == 0;
    if (is_value) element.integer(1, typeOf(field.kind));
    if (repetition != kNoRepetition) element.integer(3, repetition);
    element.text(4, field.name);
    if (!is_value) element.integer(5, static_cast<std::int64_t>(children));
    // Each as the older ConvertedType and as LogicalType, a union of empty structs.
    if (field.kind == Kind::Text) {
        element.integer(6, kUtf8).child(10, ThriftStruct().child(1, {}));
    } else if (field.kind == Kind::List) {
        element.integer(6, kListType).child(10, ThriftStruct().child(3, {}));
    }
    return element.bytes();
}

}  // namespace

void ParquetColumn::addLevels(int definition) {
    const auto add = [](std::vector<Run>& runs, int level) {
        if (runs.empty() || runs.back().level != level) runs.push_back({level, 0});
        ++runs.back().count;
    };
    ++count_;
    if (lists_ == 0) return;  // such columns have no levels
    add(repetition_, next_repetition_);
    add(definition_, definition);
    next_repetition_ = open_lists_;
    is_empty_ = false;
}

void ParquetColumn::addInteger(std::int64_t value) {
    addLevels(lists_);
    if (kind_ == Kind::Int32) {
        appendLittleEndian(values_, static_cast<std::int32_t>(value));
    } else {
        appendLittleEndian(values_, value);
    }
}

void ParquetColumn::addNumber(double value) {
    addLevels(lists_);
    if (kind_ == Kind::Float) {
        appendLittleEndian(values_, static_cast<float>(value));
    } else {
        appendLittleEndian(values_, value);
    }
}

void ParquetColumn::addBytes(std::string_view value) {
    addLevels(lists_);
    appendLittleEndian(values_, static_cast<std::uint32_t>(value.size()));
    values_ += value;
}

void ParquetColumn::beginList() {
    ++open_lists_;
    is_empty_ = true;
}

void ParquetColumn::endList() {
    --open_lists_;
    if (is_empty_) addLevels(open_lists_);
    next_repetition_ = open_lists_;
}

std::string ParquetColumn::levels() const {
    std::string all;
    if (lists_ == 0) return all;
    for (const std::vector<Run>* runs : {&repetition_, &definition_}) {
        std::string encoded;
        for (const Run& run : *runs) {
            appendVarint(encoded, run.count << 1U);
            encoded += static_cast<char>(run.level);
        }
        appendLittleEndian(all, static_cast<std::uint32_t>(encoded.size()));
        all += encoded;
    }
    return all;
}

void ParquetColumn::clear() {
    repetition_.clear();
    definition_.clear();
    count_ = 0;
    values_.clear();
}

ParquetWriter::ParquetWriter(const std::vector<ParquetField>& fields,
                             const std::map<std::string, std::string>& metadata, Sink sink)
    : sink_(std::move(sink)) {
    schema_ = schemaElement({"schema", Kind::Group}, kNoRepetition, fields.size());
    ++schema_elements_;
    for (const ParquetField& field : fields) addField(field, field.name, {field.name}, 0);
    for (const auto& [key, value] : metadata) {
        metadata_ += ThriftStruct().text(1, key).text(2, value).bytes();
        ++metadata_entries_;
    }
}

void ParquetWriter::addField(const ParquetField& field, const std::string& path,
                             const std::vector<std::string>& full_path, int lists) {
    const auto pathTo = [&](std::initializer_list<std::string> names) {
        std::vector<std::string> longer = full_path;
        longer.insert(longer.end(), names);
        return longer;
    };
    schema_ += schemaElement(field, kRequired, field.children.size());
    ++schema_elements_;
    if (field.kind == Kind::List) {
        // A list is a group of a repeated group "list" of its elements.
        schema_ += schemaElement({"list", Kind::Group}, kRepeated, 1);
        ++schema_elements_;
        addField(field.children.front(), path, pathTo({"list", "element"}), lists + 1);
    } else if (field.kind == Kind::Group) {
        for (const ParquetField& child : field.children) {
            addField(child, path + "." + child.name, pathTo({child.name}), lists);
        }
    } else {
        leaf_of_[path] = leaves_.size();
        leaves_.push_back({full_path, ParquetColumn(field.kind, lists)});
    }
}

ParquetColumn& ParquetWriter::column(const std::string& path) {
    return leaves_[leaf_of_.at(path)].values;
}

Status ParquetWriter::write(std::string_view bytes) {
    written_ += bytes.size();
    return sink_(bytes);
}

Status ParquetWriter::endRow() {
    ++group_rows_;
    std::size_t bytes = 0;
    for (const Leaf& leaf : leaves_) bytes += leaf.values.size();
    return group_rows_ >= kGroupRows || bytes >= kGroupBytes ? endGroup() : Status();
}

Result<std::string> ParquetWriter::writeColumn(Leaf& leaf) {
    ParquetColumn& column = leaf.values;
    const std::string levels = column.levels();
    const auto bytes = static_cast<std::int64_t>(levels.size() + column.values_.size());
    const auto count = static_cast<std::int64_t>(column.count_);
    const std::string header = ThriftStruct()  // PageHeader of a data page, version 1
                                   .integer(1, 0)
                                   .integer(2, bytes)
                                   .integer(3, bytes)
                                   .child(5, ThriftStruct()  // DataPageHeader
                                                 .integer(1, count)
                                                 .integer(2, kPlainEncoding)
                                                 .integer(3, kRunLengthEncoding)
                                                 .integer(4, kRunLengthEncoding))
                                   .bytes();
    const auto page = static_cast<std::int64_t>(written_);
    const std::int64_t chunk_bytes = static_cast<std::int64_t>(header.size()) + bytes;
    for (const std::string_view piece :
         {std::string_view(header), std::string_view(levels), std::string_view(column.values_)}) {
        if (Status status = write(piece); !status) return tl::unexpected(status.error());
    }
    std::string encodings;
    appendZigzag(encodings, kPlainEncoding);
    appendZigzag(encodings, kRunLengthEncoding);
    std::string path;
    for (const std::string& name : leaf.path) appendText(path, name);
    const auto metadata = ThriftStruct()  // ColumnMetaData
                              .integer(1, typeOf(column.kind_))
                              .list(2, ThriftStruct::kInt32, 2, encodings)
                              .list(3, ThriftStruct::kBinary, leaf.path.size(), path)
                              .integer(4, 0)  // not compressed
                              .integer(5, count, ThriftStruct::kInt64)
                              .integer(6, chunk_bytes, ThriftStruct::kInt64)
                              .integer(7, chunk_bytes, ThriftStruct::kInt64)
                              .integer(9, page, ThriftStruct::kInt64);
    column.clear();
    return ThriftStruct().integer(2, page, ThriftStruct::kInt64).child(3, metadata).bytes();
}

Status ParquetWriter::endGroup() {
    if (written_ == 0) {
        if (Status status = write(kParquetMagic); !status) return status;
    }
    if (group_rows_ == 0) return {};
    const std::uint64_t begin = written_;
    std::string columns;
    for (Leaf& leaf : leaves_) {
        Result<std::string> chunk = writeColumn(leaf);
        if (!chunk) return tl::unexpected(chunk.error());
        columns += *chunk;
    }
    const auto bytes = static_cast<std::int64_t>(written_ - begin);
    groups_ += ThriftStruct()
                   .list(1, ThriftStruct::kStruct, leaves_.size(), columns)
                   .integer(2, bytes, ThriftStruct::kInt64)
                   .integer(3, group_rows_, ThriftStruct::kInt64)
                   .integer(5, static_cast<std::int64_t>(begin), ThriftStruct::kInt64)
                   .integer(6, bytes, ThriftStruct::kInt64)
                   .bytes();
    ++groups_count_;
    rows_ += group_rows_;
    group_rows_ = 0;
    return {};
}

Status ParquetWriter::finish() {
    if (Status status = endGroup(); !status) return status;
    std::string footer = ThriftStruct()  // FileMetaData
                             .integer(1, 1)
                             .list(2, ThriftStruct::kStruct, schema_elements_, schema_)
                             .integer(3, rows_, ThriftStruct::kInt64)
                             .list(4, ThriftStruct::kStruct, groups_count_, groups_)
                             .list(5, ThriftStruct::kStruct, metadata_entries_, metadata_)
                             .text(6, "dollytrack")
                             .bytes();
    appendLittleEndian(footer, static_cast<std::uint32_t>(footer.size()));
    return write(footer + std::string(kParquetMagic));
}

std::uint64_t ParquetWriter::mostBytes(std::uint64_t more) const {
    // A column takes at most this in a page header, and in the footer besides its path.
    constexpr std::uint64_t kColumn = 150;
    constexpr std::uint64_t kFooter = 100;  // besides lists
    std::uint64_t bytes = written_ + more + schema_.size() + metadata_.size() + groups_.size();
    for (const Leaf& leaf : leaves_) {
        bytes += kColumn + leaf.values.levels().size() + leaf.values.size();
        for (const std::string& name : leaf.path) bytes += name.size() + 1;
    }
    return bytes + kFooter;
}

}  // namespace dollytrack::gather
