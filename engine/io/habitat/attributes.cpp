#include "engine/io/habitat/attributes.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/bounded_json.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace dollytrack::habitat {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

}  // namespace

std::optional<Eigen::Vector3d> vectorIn(const json& object, const char* key,
                                        const Eigen::Vector3d& usual) {
    const auto found = object.find(key);
    if (found == object.end() || found->is_null()) return usual;
    if (found->is_number()) return Eigen::Vector3d::Constant(found->get<double>());
    if (!found->is_array() || found->size() != 3) return std::nullopt;
    Eigen::Vector3d value;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> number = numberIn((*found)[i]);
        if (!number) return std::nullopt;
        value[static_cast<Eigen::Index>(i)] = *number;
    }
    return value;
}

std::optional<Eigen::Quaterniond> rotationIn(const json& object, const char* key) {
    const json::array_t& list = listIn(object, key);
    if (list.empty()) return Eigen::Quaterniond::Identity();
    if (list.size() != 4) return std::nullopt;
    Eigen::Vector4d q;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::optional<double> number = numberIn(list[i]);
        if (!number) return std::nullopt;
        q[static_cast<Eigen::Index>(i)] = *number;
    }
    if (!(q.norm() > 1e-6)) return std::nullopt;
    q.normalize();
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

std::optional<double> numberAt(const json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? std::nullopt : numberIn(*found);
}

bool isOff(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && !found->get<bool>();
}

bool isOn(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->get<bool>();
}

AxisKeys semanticAxisKeys(const json& attributes) {
    const bool own = attributes.contains("semantic_up") || attributes.contains("semantic_front");
    return own ? AxisKeys{"semantic_up", "semantic_front"} : AxisKeys{};
}

Eigen::Matrix3d rotationFromUpAndFront(const json& attributes, const AxisKeys& keys) {
    const Eigen::Vector3d usual_up = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d usual_front = -Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up = vectorIn(attributes, keys.up, usual_up).value_or(usual_up);
    const Eigen::Vector3d front =
        vectorIn(attributes, keys.front, usual_front).value_or(usual_front);
    const Eigen::Vector3d right = front.cross(up);
    if (!(right.norm() > 1e-6 * front.norm() * up.norm())) return Eigen::Matrix3d::Identity();
    // Orthonormal columns: right, up, front.
    Eigen::Matrix3d asset;
    asset << right.normalized(), up.normalized(), up.normalized().cross(right.normalized());
    Eigen::Matrix3d world;
    world << Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ();
    return world * asset.transpose();
}

Eigen::Affine3d scaling(const Eigen::Vector3d& scale) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    transform.linear() = scale.asDiagonal();
    return transform;
}

Eigen::Vector3d scaleOf(const json& attributes) {
    return vectorIn(attributes, "scale", Eigen::Vector3d::Ones()).value_or(Eigen::Vector3d::Ones());
}

Eigen::Affine3d modelFromAsset(const json& attributes, const AxisKeys& keys) {
    double unit = numberAt(attributes, "units_to_meters").value_or(1.0);
    if (!(unit > 0.0)) unit = 1.0;
    Eigen::Affine3d transform = scaling(unit * scaleOf(attributes));
    transform.linear() = transform.linear() * rotationFromUpAndFront(attributes, keys);
    return transform;
}

std::string withConfigName(std::string name, const fs::path& description) {
    constexpr std::string_view kConfigName = "%%CONFIG_NAME_AS_ASSET_FILENAME%%";
    if (const auto at = name.find(kConfigName); at != std::string::npos) {
        const std::string own = description.filename().string();
        name.replace(at, kConfigName.size(), own.substr(0, own.find('.')));
    }
    return name;
}

std::optional<fs::path> assetOf(const Template& found, const char* key,
                                const ReachableFiles& files) {
    const auto at = found.attributes.find(key);
    if (at == found.attributes.end() || !at->is_string()) return std::nullopt;
    return files.find(found.folder, withConfigName(at->get<std::string>(), found.file));
}

bool changesGeometry(const Template& found) {
    return std::ranges::any_of(std::array{"up", "front", "scale", "origin", "units_to_meters"},
                               [&](const char* key) { return found.attributes.contains(key); });
}

bool isNumberName(const std::string& name) {
    constexpr std::size_t kShortest = 16;
    return name.size() >= kShortest && std::all_of(name.begin(), name.end(), [](char c) {
               return std::isxdigit(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
           });
}

std::string shortName(const std::string& template_name) {
    std::string name = template_name.substr(template_name.rfind('/') + 1);
    return cleanText(name.substr(0, name.find('.')));
}

}  // namespace dollytrack::habitat
