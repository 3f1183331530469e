#pragma once

#include "engine/core/result.h"

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// A value with its location, "jobs.toml:12".
template <class T>
struct Placed {
    T value;
    std::string where;
};

/// Reads and validates the values of a TOML table. Missing keys leave the target unchanged. Only
/// the first error is kept; finish() returns it, and also refuses unknown keys.
class TableReader {
  public:
    TableReader(const toml::table& table, std::string file);

    void read(const char* key, std::string& target);
    void read(const char* key, std::optional<std::string>& target);
    void read(const char* key, std::optional<double>& target, double low, double high);
    void read(const char* key, std::optional<int>& target, int low, int high);
    void read(const char* key, bool& target);
    /// Reads a list of texts, or a single text.
    void read(const char* key, std::vector<Placed<std::string>>& target);
    void read(const char* key, std::vector<int>& target, int low, int high);

    /// The table of that name; null if it is missing.
    [[nodiscard]] const toml::table* table(const char* key);
    /// The tables of a [[list]].
    [[nodiscard]] std::vector<const toml::table*> tables(const char* key);

    [[nodiscard]] std::string placeOf(const toml::node& node) const;
    /// Location of a key's value, or of the table if the key is missing.
    [[nodiscard]] std::string placeOf(const char* key) const;
    void refuse(const std::string& where, std::string message);
    [[nodiscard]] Status finish();

  private:
    [[nodiscard]] const toml::node* find(const char* key);
    void wants(const toml::node& node, const char* key, const std::string& what);

    const toml::table& table_;
    std::string file_;
    std::vector<std::string> known_;
    std::optional<Error> error_;
};

}  // namespace dollytrack::batch
