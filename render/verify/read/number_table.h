#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// A table of comma-separated values with a header line.
class NumberTable {
  public:
    /// Reads a file. Returns BadInput, naming the line, if a row's length differs from the
    /// header's.
    static Result<NumberTable> read(const std::filesystem::path& path);

    [[nodiscard]] std::size_t rows() const { return rows_.size(); }
    [[nodiscard]] bool has(const std::string& column) const { return columns_.contains(column); }
    /// Empty for an empty field, for text that is no number, and for an unknown column.
    [[nodiscard]] std::optional<double> number(std::size_t row, const std::string& column) const;

  private:
    std::map<std::string, std::size_t> columns_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace dollytrack::verify
