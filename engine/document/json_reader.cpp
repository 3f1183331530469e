#include "engine/document/json_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace dollytrack {
namespace {

const nlohmann::json kNull;
// Larger than any scene; keeps arithmetic on file contents finite.
constexpr double kFarthest_m = 1e6;

}  // namespace

void JsonReader::refuse(std::string message) const {
    if (status_) status_ = fail(ErrorCode::BadInput, std::move(message), where_);
}

JsonReader JsonReader::at(const std::string& key) const {
    const std::string where = where_.empty() ? key : where_ + "." + key;
    if (!value_.is_object()) {
        if (!absent()) refuse("This must be an object.");
        return {kNull, where, status_};
    }
    const auto found = value_.find(key);
    return {found == value_.end() ? kNull : *found, where, status_};
}

JsonReader JsonReader::at(std::size_t index) const {
    return {value_.at(index), fmt::format("{}[{}]", where_, index), status_};
}

std::size_t JsonReader::size() const {
    if (absent()) return 0;
    if (value_.is_array()) return value_.size();
    refuse("This must be a list.");
    return 0;
}

std::string JsonReader::text() const {
    if (value_.is_string()) return value_.get<std::string>();
    refuse("This must be a text.");
    return {};
}

int JsonReader::integer(int least, int most) const {
    const double value = number(least, most);
    if (value != std::floor(value)) {
        refuse(fmt::format("This must be a whole number from {} to {}.", least, most));
        return least;
    }
    return static_cast<int>(value);
}

double JsonReader::number(double least, double most) const {
    const double value = value_.is_number() ? value_.get<double>() : std::nan("");
    if (value >= least && value <= most) return value;
    using Limits = std::numeric_limits<double>;
    refuse(least == Limits::lowest() && most == Limits::max()
               ? "This must be a finite number."
               : fmt::format("This must be a number from {} to {}.", least, most));
    return least;
}

Eigen::Vector3d JsonReader::point() const {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    if (!value_.is_array() || value_.size() != 3) {
        refuse("This must be a list of three numbers.");
        return point;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        point[static_cast<Eigen::Index>(i)] = at(i).number(-kFarthest_m, kFarthest_m);
    }
    return point;
}

}  // namespace dollytrack
