#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gather {

/// A field of a Parquet schema: a value, a list or a group of named fields. Every value is
/// required, but a list may be empty.
struct ParquetField {
    enum class Kind { Int32, Int64, Float, Double, Bytes, Text, List, Group };
    std::string name;
    Kind kind = Kind::Bytes;
    std::vector<ParquetField> children = {};  // a list has one, named "element"
};

/// Collects the values of one column until their row group is written.
class ParquetColumn {
  public:
    ParquetColumn(ParquetField::Kind kind, int lists) : kind_(kind), lists_(lists) {}

    // Adds a value of a column of Int32 or Int64, Float or Double, Bytes or Text.
    void addInteger(std::int64_t value);
    void addNumber(double value);
    void addBytes(std::string_view value);
    /// Values until endList() are in one list; lists may be nested as deep as the schema says.
    void beginList();
    void endList();

    /// Bytes that the collected values take.
    [[nodiscard]] std::size_t size() const { return values_.size(); }

  private:
    friend class ParquetWriter;
    /// A number that is repeated, in the run-length encoding of levels.
    struct Run {
        int level = 0;
        std::size_t count = 0;
    };
    void addLevels(int definition);
    [[nodiscard]] std::string levels() const;
    void clear();

    ParquetField::Kind kind_;
    int lists_;                // nested lists around a value
    int open_lists_ = 0;       // lists begun and not yet ended
    bool is_empty_ = false;    // the innermost open list has no value yet
    int next_repetition_ = 0;  // repetition level of the next value
    std::vector<Run> repetition_;
    std::vector<Run> definition_;
    std::size_t count_ = 0;  // of values and empty lists
    std::string values_;     // in PLAIN encoding
};

/// Writes a Parquet file from its beginning to its end, without compression. Equal rows give equal
/// bytes. Memory holds one row group: 100 rows, or fewer if their values exceed 32 MB.
class ParquetWriter {
  public:
    /// Takes the next bytes of the file.
    using Sink = std::function<Status(std::string_view)>;

    ParquetWriter(const std::vector<ParquetField>& fields,
                  const std::map<std::string, std::string>& metadata, Sink sink);

    /// A column by the names of its fields without those of lists: "objects.bbox". It must exist.
    [[nodiscard]] ParquetColumn& column(const std::string& path);
    /// Ends a row; each column must have one value or list more. A value of a row group may have
    /// 512 MB at most. Error: that of the sink.
    [[nodiscard]] Status endRow();
    /// Writes the last row group and the footer.
    [[nodiscard]] Status finish();

    /// Upper bound of the file's size in bytes if rows with `more` bytes of values are added and
    /// the file is finished.
    [[nodiscard]] std::uint64_t mostBytes(std::uint64_t more) const;

  private:
    struct Leaf {
        std::vector<std::string> path;  // with the names of lists
        ParquetColumn values;
    };
    void addField(const ParquetField& field, const std::string& path,
                  const std::vector<std::string>& full_path, int lists);
    [[nodiscard]] Status write(std::string_view bytes);
    /// Writes a column's values of the row group; returns its ColumnChunk for the footer.
    [[nodiscard]] Result<std::string> writeColumn(Leaf& leaf);
    [[nodiscard]] Status endGroup();

    Sink sink_;
    std::uint64_t written_ = 0;
    std::vector<Leaf> leaves_;
    std::map<std::string, std::size_t> leaf_of_;  // by column()'s path
    std::string schema_;                          // the footer's elements
    std::size_t schema_elements_ = 0;
    std::string metadata_;
    std::size_t metadata_entries_ = 0;
    std::string groups_;  // the footer's list of finished row groups
    std::size_t groups_count_ = 0;
    std::int64_t rows_ = 0;        // of all groups
    std::int64_t group_rows_ = 0;  // of the current one
};

}  // namespace dollytrack::gather
