#include "engine/io/datasets/hypersim_objects.h"

#include "engine/core/clean_text.h"
#include "engine/core/text_lists.h"
#include "engine/geometry/oriented_box.h"
#include "engine/io/files/confined_folder.h"
#include "engine/scene/label_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

/// Largest differences of annotated and computed boxes: share of the diagonal, and metres.
constexpr double kBoxShare = 0.02;
constexpr double kBox_m = 0.02;

/// Rows by name: the k-th node with a name belongs to the k-th row with that name.
class RowsByName {
  public:
    explicit RowsByName(const HypersimAnnotations& annotations) {
        for (std::size_t i = 0; i < annotations.objects.size(); ++i) {
            rows_[cleanText(annotations.objects[i])].rows.push_back(i);
        }
    }
    /// The next row of a name; -1 if there is none left.
    int take(const std::string& name) {
        const auto found = rows_.find(name);
        if (found == rows_.end() || found->second.used == found->second.rows.size()) return -1;
        return static_cast<int>(found->second.rows[found->second.used++]);
    }

  private:
    struct Rows {
        std::vector<std::size_t> rows;
        std::size_t used = 0;
    };
    std::map<std::string, Rows> rows_;
};

/// Difference of an annotated box and the computed one, in asset units: the larger of the distance
/// of their centres and the largest difference of a side. The horizontal sides may be swapped.
double boxDifference(const HypersimBox& annotated, const OrientedBox& ours) {
    const double center = (annotated.center - ours.center).norm();
    const Eigen::Vector3d size = 2.0 * ours.half_size;
    const Eigen::Vector3d swapped(size.y(), size.x(), size.z());
    const double sides = std::min((annotated.size - size).cwiseAbs().maxCoeff(),
                                  (annotated.size - swapped).cwiseAbs().maxCoeff());
    return std::max(center, sides);
}

void compareBoxes(const HypersimAnnotations& annotations, const std::map<int, std::size_t>& objects,
                  RawScene& scene) {
    if (annotations.boxes.empty()) return;
    std::size_t compared = 0;
    std::vector<std::string> different;
    for (const auto& [instance, index] : objects) {
        const auto box = annotations.boxes.find(instance);
        if (box == annotations.boxes.end()) continue;
        std::vector<Eigen::Vector3f> points;
        for (const std::size_t part : scene.objects[index].parts) {
            const auto& positions = scene.parts[part].positions;
            points.insert(points.end(), positions.begin(), positions.end());
        }
        if (points.empty()) continue;
        ++compared;
        const double difference = boxDifference(box->second, fitUprightBox(points));
        const double unit = annotations.meters_per_unit.value_or(1.0);
        const double allowed = std::max(kBoxShare * box->second.size.norm(),
                                        annotations.meters_per_unit ? kBox_m / unit : 0.0);
        if (difference <= allowed) continue;
        different.push_back(fmt::format("{} by {:.3g}{}", scene.objects[index].name,
                                        difference * unit,
                                        annotations.meters_per_unit ? " m" : " units"));
    }
    if (compared == 0) return;
    scene.notes.push_back(
        fmt::format("annotated boxes that agree with the measured ones to 2 cm or 2 %: {} of {}{}",
                    compared - different.size(), compared,
                    different.empty() ? "" : "; different: " + listOf(different)));
}

struct Matches {
    std::size_t nodes = 0;    // nodes with a mesh and a row
    std::size_t unknown = 0;  // nodes with a mesh but no row
    std::size_t other_class = 0;
};

void noteMatches(const HypersimAnnotations& annotations, const Matches& matches, RawScene& scene) {
    scene.notes.push_back(
        fmt::format("{} of {} that the Hypersim annotations list are in the scene file",
                    matches.nodes, counted(annotations.objects.size(), "mesh", "meshes")));
    if (matches.unknown > 0) {
        scene.warnings.push_back(counted(
            matches.unknown, "mesh has no Hypersim annotation, so its class is found by its name",
            "meshes have no Hypersim annotations, so their classes are found by their names"));
    }
    if (matches.other_class > 0) {
        scene.warnings.push_back(
            counted(matches.other_class, "mesh has", "meshes have") +
            " another class than the first mesh of the same instance, whose class is used");
    }
}

}  // namespace

fs::path findHypersimBeside(const fs::path& scene_file) {
    std::error_code error;
    const fs::path beside = fs::absolute(scene_file, error).lexically_normal().parent_path();
    for (const fs::path& folder : {beside, beside.parent_path()}) {
        const fs::path found = findHypersimMesh(folder);
        if (!found.empty() && hasFile(found / "mesh_objects_si.hdf5")) return found;
    }
    return {};
}

void applyHypersim(const HypersimAnnotations& annotations, RawScene& scene) {
    std::map<int, std::vector<std::size_t>> parts_of_node;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        if (!scene.parts[i].triangles.empty()) parts_of_node[scene.parts[i].node].push_back(i);
    }
    RowsByName rows(annotations);
    Matches matches;
    std::map<int, std::size_t> object_of_instance;
    std::vector<SourceObject> objects;
    for (const auto& [node, parts] : parts_of_node) {
        const std::string& name = scene.nodes[node].name;
        const int row = rows.take(name);
        ++(row < 0 ? matches.unknown : matches.nodes);
        const int nyu40 = row < 0 ? 0 : annotations.nyu40[row];
        const int instance = row < 0 ? 0 : annotations.instance[row];
        const auto known = object_of_instance.find(instance);
        if (instance > 0 && known != object_of_instance.end()) {
            SourceObject& whole = objects[known->second];
            whole.parts.insert(whole.parts.end(), parts.begin(), parts.end());
            matches.other_class += whole.nyu40 != nyu40;
            continue;
        }
        if (instance > 0) object_of_instance[instance] = objects.size();
        SourceObject object;
        object.name = name;
        object.nyu40 = nyu40;
        object.structure = isStructureClass(nyu40);
        object.parts = parts;
        objects.push_back(std::move(object));
    }
    // These are another scene's annotations, so leave the scene unchanged.
    if (matches.nodes == 0) {
        scene.warnings.push_back("none of the meshes that the annotations in " +
                                 annotations.folder.string() +
                                 " name is in the file; they were left out");
        return;
    }
    scene.objects = std::move(objects);
    scene.file_up_axis = 'z';
    if (annotations.meters_per_unit) scene.file_unit_m = annotations.meters_per_unit;
    noteMatches(annotations, matches, scene);
    compareBoxes(annotations, object_of_instance, scene);
}

}  // namespace dollytrack
