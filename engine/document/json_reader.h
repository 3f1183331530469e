#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack {

/// Reads values from JSON that may have been written by hand, and records the first error: one
/// sentence and its place. After an error all values read are empty, so a caller checks good()
/// once, at the end.
class JsonReader {
  public:
    JsonReader(const nlohmann::json& value, std::string where, Status& status)
        : value_(value), where_(std::move(where)), status_(status) {}

    /// A member of an object (null if it is missing), or an entry of a list.
    [[nodiscard]] JsonReader at(const std::string& key) const;
    [[nodiscard]] JsonReader at(std::size_t index) const;

    [[nodiscard]] bool absent() const { return value_.is_null(); }
    [[nodiscard]] std::size_t size() const;  // of a list; 0 when absent

    [[nodiscard]] std::string text() const;
    [[nodiscard]] int integer(int least, int most) const;
    [[nodiscard]] double number(double least, double most) const;
    [[nodiscard]] Eigen::Vector3d point() const;  // three finite numbers

    void refuse(std::string message) const;
    [[nodiscard]] bool good() const { return status_.has_value(); }
    [[nodiscard]] const nlohmann::json& json() const { return value_; }

  private:
    const nlohmann::json& value_;
    std::string where_;
    Status& status_;
};

}  // namespace dollytrack
