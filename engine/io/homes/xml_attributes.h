#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>
#include <pugixml.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace dollytrack::homes {

/// Reads an element's attributes; the first that is wrong is kept as the reason.
class XmlAttributes {
  public:
    XmlAttributes(const pugi::xml_node& node, std::string where)
        : node_(node), where_(std::move(where)) {}

    [[nodiscard]] bool has(const char* name) const { return !node_.attribute(name).empty(); }
    [[nodiscard]] std::string text(const char* name) const;  // clean
    [[nodiscard]] bool flag(const char* name, bool otherwise) const;
    /// A finite number of at most a million (10 km).
    double number(const char* name, double otherwise);
    double needed(const char* name);
    /// A number above 0.
    double size(const char* name, double otherwise);
    /// "FF00376B" as a linear colour.
    std::optional<Eigen::Vector3f> color(const char* name);
    /// Nine numbers, row by row.
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
