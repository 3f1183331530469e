#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// One field of a PCD file: `count` numbers of `size` bytes.
struct PcdField {
    std::string name;
    std::size_t size = 4;  // 1, 2, 4 or 8
    char type = 'F';       // F: float, I: signed, U: unsigned
    std::size_t count = 1;
    std::size_t offset = 0;  // bytes from the start of a point
};

struct PcdHeader {
    std::vector<PcdField> fields;
    std::size_t width = 0;
    std::size_t height = 1;
    std::size_t points = 0;
    std::size_t point_bytes = 0;
    Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
    std::string data;      // "ascii", "binary", "binary_compressed"
    std::size_t size = 0;  // bytes of the header itself
    int lines = 0;

    [[nodiscard]] const PcdField* find(std::string_view name) const;
};

/// Parses a header, and checks that counts and types are consistent and within the limits. Error:
/// BadInput, with the line.
Result<PcdHeader> readPcdHeader(std::string_view bytes, const std::string& name);

}  // namespace dollytrack
