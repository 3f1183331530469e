#include "engine/scene/scene_report.h"

#include "engine/core/clean_text.h"
#include "engine/scene/labels.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace dollytrack {
namespace {

using nlohmann::json;

/// Rounds to millimetres, so that the text is the same on all machines.
double rounded(double value) {
    const double r = std::round(value * 1000.0) / 1000.0;
    return r == 0.0 ? 0.0 : r;
}

json point(const Eigen::Vector3d& p) {
    return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

std::string nyu40Class(int nyu40) {
    return nyu40 == 0 ? std::string("unknown") : std::string(nyu40Name(nyu40));
}

int countTargets(const Scene& scene) {
    return static_cast<int>(
        std::count_if(scene.objects.begin(), scene.objects.end(),
                      [](const Object& object) { return object.role == Role::Target; }));
}

json objectJson(const Object& object) {
    json one = {{"id", object.id},
                {"name", object.name},
                {"class", nyu40Class(object.nyu40)},
                {"role", roleName(object.role)},
                {"large", object.large},
                {"size_m", point(2.0 * object.box.half_size)},
                {"center_m", point(object.box.center)},
                {"yaw_deg", rounded(object.box.yaw * 180.0 / std::numbers::pi)},
                {"front", point(object.front)},
                {"front_source", frontSourceName(object.front_source)},
                {"triangles", object.triangle_count}};
    if (object.dataset_class) {
        one["dataset_class"] = {{"id", object.dataset_class->id},
                                {"name", object.dataset_class->name}};
    }
    return one;
}

/// The number of objects of a class of the label file.
std::ptrdiff_t countOf(const Scene& scene, const DatasetClass& one) {
    return std::ranges::count_if(scene.objects, [&](const Object& object) {
        return scene.classes().classOf(object).id == one.id;
    });
}

json datasetClassesJson(const Scene& scene) {
    json list = json::array();
    const auto add = [&](const DatasetClass& one) {
        list.push_back({{"id", one.id}, {"name", one.name}, {"objects", countOf(scene, one)}});
    };
    add(scene.classes().voidClass());
    for (const DatasetClass& one : scene.classes().classes()) add(one);
    return list;
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), pattern, values...);
    return text.data();
}

/// Truncates or pads text to a width in characters, without splitting a UTF-8 character.
std::string column(std::string text, std::size_t width) {
    std::size_t characters = 0;
    std::size_t end = 0;
    while (end < text.size() && characters < width) {
        ++end;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
        ++characters;
    }
    text.resize(end);
    return text + std::string(width - characters, ' ');
}

}  // namespace

std::string className(const Object& object) {
    return object.dataset_class ? object.dataset_class->name : nyu40Class(object.nyu40);
}

std::string_view roleName(Role role) {
    switch (role) {
        case Role::Target:
            return "target";
        case Role::Structure:
            return "structure";
        case Role::Excluded:
            return "excluded";
    }
    return "";
}

std::string_view frontSourceName(FrontSource source) {
    switch (source) {
        case FrontSource::Annotation:
            return "annotation";
        case FrontSource::Wall:
            return "wall";
        case FrontSource::ShortSide:
            return "short_side";
        case FrontSource::RoomCentre:
            return "room_centre";
    }
    return "";
}

json toJson(const Scene& scene) {
    std::map<std::string, int> classes;
    json objects = json::array();
    for (const Object& object : scene.objects) {
        ++classes[nyu40Class(object.nyu40)];
        objects.push_back(objectJson(object));
    }
    json report = {{"name", scene.name},
                   {"source", cleanText(scene.source.string())},
                   {"source_sha256", scene.source_sha256},
                   {"unit_m", scene.report.unit_m},
                   {"unit_source", scene.report.unit_source},
                   {"up_axis", scene.report.up_axis},
                   {"up_source", scene.report.up_source},
                   {"bounds_min_m", point(scene.room_bounds.min())},
                   {"bounds_max_m", point(scene.room_bounds.max())},
                   {"size_m", point(scene.room_bounds.sizes())},
                   {"triangles", scene.triangles.size()},
                   {"vertices", scene.positions.size()},
                   {"materials", scene.materials.size()},
                   {"textures_found", scene.report.textures_found},
                   {"textures_missing", scene.report.textures_missing},
                   {"targets", countTargets(scene)},
                   {"classes", classes},
                   {"objects", objects},
                   {"notes", scene.report.notes},
                   {"warnings", scene.report.warnings}};
    if (scene.class_table) report["dataset_classes"] = datasetClassesJson(scene);
    return report;
}

std::string describeScene(const Scene& scene) {
    const Eigen::Vector3d size = scene.room_bounds.sizes();
    std::string text = scene.name + "\n";
    text += format("  size       %.2f x %.2f x %.2f m\n", size.x(), size.y(), size.z());
    text +=
        format("  unit       %g m (%s)\n", scene.report.unit_m, scene.report.unit_source.c_str());
    text += format("  up         %s (%s)\n", scene.report.up_axis.c_str(),
                   scene.report.up_source.c_str());
    text +=
        format("  objects    %zu, of them %d targets\n", scene.objects.size(), countTargets(scene));
    if (scene.class_table) {
        const std::span<const DatasetClass> classes = scene.classes().classes();
        const std::ptrdiff_t used = std::ranges::count_if(
            classes, [&](const DatasetClass& one) { return countOf(scene, one) > 0; });
        text += format("  classes    %td of the %zu in the label file; %td objects have none\n",
                       used, classes.size(), countOf(scene, scene.classes().voidClass()));
    }
    text += format("  triangles  %zu\n", scene.triangles.size());
    text += format("  textures   %d found, %zu missing\n", scene.report.textures_found,
                   scene.report.textures_missing.size());
    for (const std::string& warning : scene.report.warnings)
        text += "  doubtful   " + warning + "\n";

    std::size_t name_width = 4;
    for (const Object& object : scene.objects) {
        name_width = std::max(name_width, object.name.size());
    }
    name_width = std::min<std::size_t>(name_width, 40);
    text += "\n   id  " + column("name", name_width) +
            "  class           role       size   width  depth height m  front\n";
    for (const Object& object : scene.objects) {
        text += format("  %3d  ", object.id) + column(object.name, name_width) + "  " +
                column(className(object), 14) + "  " +
                column(std::string(roleName(object.role)), 9) + "  " +
                (object.large ? "large" : "small") +
                format("  %5.2f  %5.2f  %5.2f    ", 2.0 * object.box.half_size.x(),
                       2.0 * object.box.half_size.y(), 2.0 * object.box.half_size.z()) +
                std::string(frontSourceName(object.front_source)) + "\n";
    }
    constexpr std::size_t kMostMissing = 12;
    const std::vector<std::string>& missing = scene.report.textures_missing;
    for (std::size_t i = 0; i < std::min(missing.size(), kMostMissing); ++i) {
        text += "\n  missing texture: " + missing[i];
    }
    if (missing.size() > kMostMissing) {
        text += "\n  missing textures: " + std::to_string(missing.size() - kMostMissing) + " more";
    }
    for (const std::string& note : scene.report.notes) text += "\n  note: " + note;
    return text + "\n";
}

}  // namespace dollytrack
