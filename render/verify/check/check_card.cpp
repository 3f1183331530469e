#include "engine/io/files/bounded_json.h"
#include "engine/io/files/sha256.h"
#include "engine/scene/labels.h"
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace dollytrack::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

class CardReport {
  public:
    explicit CardReport(Findings& findings) : findings_(findings) {}

    void add(const std::string& place, std::string found, std::string expected) {
        findings_.add(
            {"dataset.json", {}, {}, place + " is " + std::move(found), std::move(expected)});
    }
    void near(const std::string& place, double found, double expected) {
        if (std::abs(found - expected) <= 1e-9 * std::max(1.0, std::abs(expected))) return;
        add(place, fmt::format("{:.12g}", found), fmt::format("{:.12g}", expected));
    }
    void same(const std::string& place, const OrderedJson& found, const OrderedJson& expected) {
        if (found != expected) add(place, found.dump(), expected.dump());
    }

  private:
    Findings& findings_;
};

/// Checks that pixels are square, the axis is central, the focal length matches the field of view,
/// and that all agree with parameters.camera.
void checkLens(const StoredDataset& dataset, CardReport& report) {
    const Intrinsics& lens = dataset.lens;
    const std::string at = "conventions.intrinsics.";
    const double half = dataset.hfov_deg * std::numbers::pi / 360.0;
    report.near(at + "fx", lens.fx, 0.5 * lens.width / std::tan(half));
    report.near(at + "fy", lens.fy, lens.fx);
    report.near(at + "cx", lens.cx, 0.5 * lens.width);
    report.near(at + "cy", lens.cy, 0.5 * lens.height);
    const OrderedJson& parameters = dataset.card.at("parameters");
    if (!parameters.contains("camera")) return;
    const OrderedJson& camera = parameters["camera"];
    report.near(at + "width", lens.width, camera.value("width_px", 0.0));
    report.near(at + "height", lens.height, camera.value("height_px", 0.0));
    report.near(at + "hfov_deg", dataset.hfov_deg, camera.value("hfov_deg", 0.0));
    report.near(at + "near_m", dataset.near_m, camera.value("near_m", 0.0));
}

/// Checks conventions that readers take for granted.
void checkConventions(const StoredDataset& dataset, CardReport& report) {
    const OrderedJson& all = dataset.card.at("conventions");
    const auto same = [&](const std::string& group, const char* key, const OrderedJson& expected) {
        const OrderedJson& of = group.empty() ? all : all.at(group);
        const std::string place = "conventions." + (group.empty() ? "" : group + ".") + key;
        report.same(place, of.contains(key) ? of[key] : OrderedJson(), expected);
    };
    same("", "length_unit", "m");
    same("", "quaternion_order", "x y z w");
    same("world", "handedness", "right");
    same("world", "up", "z");
    if (dataset.has("depth")) {
        same("depth", "kind", "planar");
        same("depth", "scale_m", 0.001);
        same("depth", "invalid", 0);
    }
}

void checkTables(const StoredDataset& dataset, CardReport& report) {
    const OrderedJson& classes = dataset.card.at("classes");
    const ClassTable& table = dataset.classes();
    report.same("the number of classes", classes.size(), table.classes().size() + 1);
    for (std::size_t i = 0; i < classes.size() && i <= table.classes().size(); ++i) {
        const DatasetClass& expected = i == 0 ? table.voidClass() : table.classes()[i - 1];
        const std::string place = fmt::format("classes[{}]", i);
        report.same(place + ".id", classes[i].at("id"), expected.id);
        report.same(place + ".name", classes[i].at("name"), expected.name);
        report.same(place + ".color", classes[i].value("color", OrderedJson()), expected.color);
    }
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        const StoredObject& object = dataset.objects[i];
        const std::string place = fmt::format("objects[{}]", i);
        report.same(place + ".id", object.id, static_cast<int>(i) + 1);
        if (object.nyu40 < 0 || object.nyu40 > kNyu40Count) {
            report.add(place + ".nyu40", std::to_string(object.nyu40), "0 .. 40");
        }
        if (!table.isNyu40()) {
            report.same(place + ".class_id", object.class_id,
                        table.classFor(object.name, object.nyu40).id);
        }
    }
}

/// Checks that objects stand or hang on existing objects.
void checkRelations(const StoredDataset& dataset, CardReport& report) {
    const OrderedJson& objects = dataset.card.at("objects");
    for (std::size_t i = 0; i < objects.size(); ++i) {
        for (const OrderedJson& relation : objects[i].at("relations")) {
            const std::string place = fmt::format("a relation of objects[{}]", i);
            const auto kind = relation.at("kind").get<std::string>();
            if (kind != "on" && kind != "in" && kind != "hangs_on") {
                report.add(place, kind, "on, in or hangs_on");
            }
            const int other = relation.at("id").get<int>();
            if (!dataset.object(other) || other == objects[i].at("id")) {
                report.add(place, fmt::format("to object {}", other), "another of the list");
            }
        }
    }
}

void checkFrames(const StoredDataset& dataset, CardReport& report) {
    const OrderedJson& frames = dataset.card.at("frames");
    report.same("trajectory_sha256", dataset.card.at("trajectory_sha256"),
                sha256Of(std::string_view(frames.dump())));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        report.same(fmt::format("frames[{}].index", i), frames[i].at("index"), i);
        for (const MovedObject& moved : dataset.frames[i].moving) {
            if (dataset.object(moved.object_id)) continue;
            report.add(fmt::format("frames[{}].moving", i),
                       fmt::format("of object {}", moved.object_id), "an object of the list");
        }
    }
}

}  // namespace

CheckWork beginCard(const Subject& subject, Findings& findings) {
    CardReport report(findings);
    try {
        checkLens(subject.dataset, report);
        checkConventions(subject.dataset, report);
        checkTables(subject.dataset, report);
        checkRelations(subject.dataset, report);
        checkFrames(subject.dataset, report);
    } catch (const nlohmann::json::exception& error) {
        findings.add({"dataset.json", {}, {}, plainReason(error), "all fields of dataset.json"});
    }
    return {};
}

}  // namespace dollytrack::verify
