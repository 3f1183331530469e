#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// A text of comma separated values with a line of names.
class NumberTable {
  public:
    /// Errors: BadInput, with the line, for rows that are longer or shorter than the names.
    static Result<NumberTable> read(const std::filesystem::path& path);

    [[nodiscard]] std::size_t rows() const { return rows_.size(); }
    [[nodiscard]] bool has(const std::string& column) const { return columns_.contains(column); }
    /// Nothing for an empty field, one that is no number, and a column that is not there.
    [[nodiscard]] std::optional<double> number(std::size_t row, const std::string& column) const;

  private:
    std::map<std::string, std::size_t> columns_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace dollytrack::verify
