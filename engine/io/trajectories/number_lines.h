#pragma once

#include "engine/core/result.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::io {

/// A line of a text file that holds numbers.
struct NumberLine {
    int line = 0;  // 1..
    std::vector<double> values;
};

/// The words of a line, separated by blanks, tabs or commas.
std::vector<std::string_view> splitWords(std::string_view line);

/// The lines of a text, without their ends.
std::vector<std::string_view> splitLines(std::string_view text);

/// "file.txt:12", for errors.
std::string placeOf(const std::filesystem::path& path, int line);

/// A number, also as "+1.5"; 0 or infinity where it is too small or too large for a double. Nothing
/// where the text is no number.
std::optional<double> numberFrom(std::string_view text);

/// A finite number. Error: BadInput, with the place.
Result<double> parseNumber(std::string_view word, const std::filesystem::path& path, int line);

/// The lines of a text from `first_line` on that are neither empty nor begin with '#'; each must
/// hold `count` numbers. `path` is where the text came from. Error: BadInput, with the line, also
/// when there is none.
Result<std::vector<NumberLine>> readNumberLines(const std::filesystem::path& path,
                                                std::string_view text, std::size_t count,
                                                std::string_view meaning, int first_line = 1);

/// A rotation from a quaternion that is nearly unit. Error: BadInput, with the place.
Result<Eigen::Matrix3d> rotationFrom(double w, double x, double y, double z,
                                     const std::string& where);

/// The rotation of a camera that looks along `forward`, its roll given by `up`. Neither need be
/// unit. Error: BadInput, with the place, when the two leave the roll open.
Result<Eigen::Matrix3d> rotationAlong(const Eigen::Vector3d& forward, const Eigen::Vector3d& up,
                                      const std::string& where);

/// A 3x3 matrix as a rotation, when it nearly is one. Error: BadInput, with the place.
Result<Eigen::Matrix3d> rotationFrom(const Eigen::Matrix3d& matrix, const std::string& where);

}  // namespace dollytrack::io
