#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>
#include <pugixml.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace dollytrack::homes {

/// Reads an element's attributes; error() is the first invalid one.
class XmlAttributes {
  public:
    XmlAttributes(const pugi::xml_node& node, std::string where)
        : node_(node), where_(std::move(where)) {}

    [[nodiscard]] bool has(const char* name) const { return !node_.attribute(name).empty(); }
    [[nodiscard]] std::string text(const char* name) const;  // clean
    [[nodiscard]] bool flag(const char* name, bool otherwise) const;
    /// A finite number with an absolute value of at most a million (10 km); `otherwise` if missing.
    double number(const char* name, double otherwise);
    double needed(const char* name);
    /// A size above 0; a value of 0 becomes 0.1 cm, and negative values are errors.
    double size(const char* name, double otherwise);
    /// A colour such as "FF00376B", as linear colour.
    std::optional<Eigen::Vector3f> color(const char* name);
    /// A matrix of nine numbers, row by row.
    std::optional<Eigen::Matrix3d> matrix(const char* name);

    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  private:
    double parse(const char* name, std::string_view text);
    void wrong(const char* name, const std::string& why);

    pugi::xml_node node_;
    std::string where_;
    std::optional<Error> error_;
};

}  // namespace dollytrack::homes
