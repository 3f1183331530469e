#include "engine/io/files/number_lines.h"

#include <fmt/format.h>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace dollytrack {
namespace {
constexpr double kUnitTolerance = 1e-2;  // some files have only three decimals
}  // namespace

std::vector<std::string_view> splitWords(std::string_view line) {
    constexpr std::string_view kBlanks = " \t,\r";
    std::vector<std::string_view> words;
    std::size_t at = line.find_first_not_of(kBlanks);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlanks, end);
    }
    return words;
}

std::vector<std::string_view> splitLines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        lines.push_back(line);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return lines;
}

std::string placeOf(const std::filesystem::path& path, int line) {
    return fmt::format("{}:{}", path.string(), line);
}

std::optional<double> numberFrom(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (last != text.data() + text.size() || error == std::errc::invalid_argument) {
        return std::nullopt;
    }
    if (error == std::errc()) return value;
    // Out of range: the decimal exponent of its first non-zero digit tells whether it is too large
    // or too small.
    const std::size_t end = std::min(text.find_first_of("eE"), text.size());
    const std::string_view digits = text.substr(0, end);
    std::string_view power = text.substr(std::min(end + 1, text.size()));
    if (power.starts_with('+')) power.remove_prefix(1);
    long long exponent = 0;
    const auto parsed = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (parsed.ec == std::errc::result_out_of_range) {
        exponent = std::numeric_limits<long long>::max() / (power[0] == '-' ? -2 : 2);
    }
    const auto point = static_cast<long long>(std::min(digits.find('.'), end));
    const auto first = static_cast<long long>(std::min(digits.find_first_of("123456789"), end));
    const double size =
        exponent + point - first > 0 ? std::numeric_limits<double>::infinity() : 0.0;
    return text[0] == '-' ? -size : size;
}

Result<double> parseNumber(std::string_view word, const std::filesystem::path& path, int line) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
        return fail(ErrorCode::BadInput, fmt::format("\"{}\" is not a finite number.", word),
                    placeOf(path, line));
    }
    return value;
}

Result<std::vector<NumberLine>> readNumberLines(const std::filesystem::path& path,
                                                std::string_view text, std::size_t count,
                                                std::string_view meaning, int first_line) {
    std::vector<NumberLine> result;
    int number = 0;
    for (const std::string_view line : splitLines(text)) {
        if (++number < first_line) continue;
        const auto words = splitWords(line);
        if (words.empty() || words.front().front() == '#') continue;
        if (words.size() != count) {
            return fail(ErrorCode::BadInput,
                        fmt::format("There are {} values where {} are needed ({}).", words.size(),
                                    count, meaning),
                        placeOf(path, number));
        }
        NumberLine read{number, {}};
        for (const std::string_view word : words) {
            Result<double> value = parseNumber(word, path, number);
            if (!value) return tl::unexpected(std::move(value.error()));
            read.values.push_back(*value);
        }
        result.push_back(std::move(read));
    }
    if (result.empty()) {
        return fail(ErrorCode::BadInput,
                    fmt::format("The file has no lines of values ({}).", meaning), path.string());
    }
    return result;
}

Result<Eigen::Matrix3d> rotationFrom(double w, double x, double y, double z,
                                     const std::string& where) {
    const Eigen::Quaterniond q(w, x, y, z);
    if (std::abs(q.norm() - 1.0) > kUnitTolerance) {
        return fail(
            ErrorCode::BadInput,
            fmt::format("The quaternion has the length {:.4g} instead of 1; is this another "
                        "format?",
                        q.norm()),
            where);
    }
    return q.normalized().toRotationMatrix();
}

Result<Eigen::Matrix3d> rotationAlong(const Eigen::Vector3d& forward, const Eigen::Vector3d& up,
                                      const std::string& where) {
    const Eigen::Vector3d right = forward.cross(up);
    // Vectors whose squared length overflows have no direction either.
    if (!(right.norm() > 1e-9) || !std::isfinite(right.norm()) || !std::isfinite(forward.norm())) {
        return fail(ErrorCode::BadInput,
                    "The camera looks at its own position, or straight up or down, so its roll is "
                    "undefined.",
                    where);
    }
    Eigen::Matrix3d rotation;
    rotation.col(0) = right.normalized();
    rotation.col(2) = forward.normalized();
    rotation.col(1) = rotation.col(2).cross(rotation.col(0));
    return rotation;
}

Result<Eigen::Matrix3d> rotationFrom(const Eigen::Matrix3d& matrix, const std::string& where) {
    const bool rotates =
        matrix.allFinite() && matrix.determinant() > 0.0 &&
        (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).norm() < kUnitTolerance * 4.0;
    if (!rotates) {
        return fail(ErrorCode::BadInput, "The matrix is not a rotation.", where);
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose());
}

}  // namespace dollytrack
