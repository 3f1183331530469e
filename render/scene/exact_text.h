#pragma once

#include <fmt/format.h>
#include <Eigen/Core>

#include <string>

namespace dollytrack::render {

/// Numbers in shortest exact form, locale-independent, each after a space.
template <class Vector>
std::string exactText(const Vector& values) {
    std::string result;
    for (Eigen::Index i = 0; i < values.size(); ++i) result += fmt::format(" {}", values[i]);
    return result;
}

}  // namespace dollytrack::render
