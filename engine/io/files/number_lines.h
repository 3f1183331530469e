#pragma once

#include "engine/core/result.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The numbers in a line of a text file.
struct NumberLine {
    int line = 0;  // from 1
    std::vector<double> values;
};

/// Splits a line into words, separated by blanks, tabs or commas.
std::vector<std::string_view> splitWords(std::string_view line);

/// Splits a text into lines, without line ends.
std::vector<std::string_view> splitLines(std::string_view text);

/// File and line for errors: "file.txt:12".
std::string placeOf(const std::filesystem::path& path, int line);

/// Parses a number; a leading "+" is permitted. Returns 0 or infinity if it is too small or too
/// large for a double, and nullopt if the text is not a number.
std::optional<double> numberFrom(std::string_view text);

/// Parses a finite number. Error: BadInput, with the line.
Result<double> parseNumber(std::string_view word, const std::filesystem::path& path, int line);

/// Parses the lines of a text from `first_line` on, except empty lines and those that begin with
/// '#'. Each must contain `count` numbers, described by `meaning` in errors. `path` is the text's
/// file. Error: BadInput, with the line, also if there are no such lines.
Result<std::vector<NumberLine>> readNumberLines(const std::filesystem::path& path,
                                                std::string_view text, std::size_t count,
                                                std::string_view meaning, int first_line = 1);

/// A rotation from a quaternion. Error: BadInput at `where` if its length is not nearly 1.
Result<Eigen::Matrix3d> rotationFrom(double w, double x, double y, double z,
                                     const std::string& where);

/// The rotation of a camera that looks along `forward`, with its roll given by `up`. The vectors
/// may have any length. Error: BadInput at `where` if they are parallel or zero.
Result<Eigen::Matrix3d> rotationAlong(const Eigen::Vector3d& forward, const Eigen::Vector3d& up,
                                      const std::string& where);

/// The rotation nearest to a matrix. Error: BadInput at `where` if it is not nearly a rotation.
Result<Eigen::Matrix3d> rotationFrom(const Eigen::Matrix3d& matrix, const std::string& where);

}  // namespace dollytrack
