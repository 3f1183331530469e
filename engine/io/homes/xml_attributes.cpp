#include "engine/io/homes/xml_attributes.h"

#include "engine/core/clean_text.h"
#include "engine/scene/srgb.h"

#include <charconv>

namespace dollytrack::homes {
namespace {

constexpr double kLargest = 1e6;

float toLinear(unsigned byte) {
    return linearFromSrgb(static_cast<float>(byte) / 255.0F);
}

}  // namespace

std::string XmlAttributes::text(const char* name) const {
    return cleanText(node_.attribute(name).value());
}

bool XmlAttributes::flag(const char* name, bool otherwise) const {
    const std::string_view value = node_.attribute(name).value();
    return value.empty() ? otherwise : value == "true";
}

void XmlAttributes::wrong(const char* name, const std::string& why) {
    if (error_) return;
    error_ = Error{ErrorCode::BadInput,
                   std::string("the ") + name + " of a <" + cleanText(node_.name()) + "> " + why +
                       "; save the home again with Sweet Home 3D",
                   where_};
}

double XmlAttributes::parse(const char* name, std::string_view text) {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        wrong(name, "is not a number (\"" + cleanText(text.substr(0, 40)) + "\")");
        return 0.0;
    }
    if (std::abs(value) > kLargest) {
        wrong(name, "is larger than 10 km");
        return 0.0;
    }
    return value;
}

double XmlAttributes::number(const char* name, double otherwise) {
    return has(name) ? parse(name, node_.attribute(name).value()) : otherwise;
}

double XmlAttributes::needed(const char* name) {
    if (!has(name)) wrong(name, "is missing");
    return number(name, 0.0);
}

double XmlAttributes::size(const char* name, double otherwise) {
    const double value = number(name, otherwise);
    if (value > 0.0) return value;
    // Sizes of 0 are replaced by a small one, which is still visible.
    if (value == 0.0) return 0.1;
    wrong(name, "is negative");
    return 1.0;
}

std::optional<Eigen::Vector3f> XmlAttributes::color(const char* name) {
    if (!has(name)) return std::nullopt;
    const std::string_view text = node_.attribute(name).value();
    std::uint32_t argb = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), argb, 16);
    if (status != std::errc{} || end != text.data() + text.size()) {
        wrong(name, "is not a colour");
        return std::nullopt;
    }
    return Eigen::Vector3f(toLinear(argb >> 16U & 255U), toLinear(argb >> 8U & 255U),
                           toLinear(argb & 255U));
}

std::optional<Eigen::Matrix3d> XmlAttributes::matrix(const char* name) {
    if (!has(name)) return std::nullopt;
    const std::string_view text = node_.attribute(name).value();
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    std::size_t at = 0;
    for (int i = 0; i < 9; ++i) {
        at = text.find_first_not_of(' ', at);
        if (at == std::string_view::npos) {
            wrong(name, "has not nine numbers");
            return std::nullopt;
        }
        const std::size_t end = std::min(text.find(' ', at), text.size());
        matrix(i / 3, i % 3) = parse(name, text.substr(at, end - at));
        at = end;
    }
    return matrix;
}

}  // namespace dollytrack::homes
