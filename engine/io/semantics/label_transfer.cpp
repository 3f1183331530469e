#include "engine/io/semantics/label_transfer.h"

#include "engine/core/text_lists.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/io/semantics/labelled_surface.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dollytrack::semantics {
namespace {

Eigen::AlignedBox3d boundsOf(const RawScene& scene) {
    Eigen::AlignedBox3d box;
    for (const MeshPart& part : scene.parts) {
        if (!part.triangles.empty()) box.extend(part.bounds.cast<double>());
    }
    return box;
}

/// Mean distance of a mesh from the labelled surfaces, over about 2000 triangle centres.
double meanDistance(const RawScene& textured, const Eigen::Affine3d& rotation,
                    const LabelledSurface& surface, double radius, const JobContext& job) {
    constexpr std::size_t kEnough = 2000;
    std::size_t count = 0;
    for (const MeshPart& part : textured.parts) count += part.triangles.size();
    const std::size_t step = count / kEnough + 1;
    double sum = 0.0;
    std::size_t at = 0;
    for (const MeshPart& part : textured.parts) {
        for (const Triangle& triangle : part.triangles) {
            if (at++ % step > 0) continue;
            if (job.cancelled()) return 0.0;
            sum += surface.distance(middleOf(cornersOf(part, triangle, rotation)), radius);
        }
    }
    return sum / static_cast<double>((count + step - 1) / step);
}

/// The rotation between the two meshes of a scan, which may have different up axes: the one that
/// makes their bounding boxes most similar or, of several such, brings their surfaces closest.
Eigen::Affine3d labelledFromTextured(const Eigen::AlignedBox3d& labelled, const RawScene& textured,
                                     const LabelledSurface& surface, double radius,
                                     const JobContext& job) {
    constexpr double kAlike = 0.01;  // of the diagonal
    const Eigen::AlignedBox3d box = boundsOf(textured);
    std::array<Eigen::Affine3d, 3> rotations;
    rotations.fill(Eigen::Affine3d::Identity());
    if (labelled.isEmpty() || box.isEmpty()) return rotations[0];
    rotations[1].linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    rotations[2].linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    std::array<double, 3> apart{};
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const Eigen::AlignedBox3d rotated = box.transformed(rotations[i]);
        apart[i] =
            (rotated.min() - labelled.min()).norm() + (rotated.max() - labelled.max()).norm();
    }
    const double most = std::ranges::min(apart) + kAlike * box.diagonal().norm();
    std::optional<std::size_t> best;
    double least = 0.0;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        if (apart[i] > most) continue;
        const double mean = meanDistance(textured, rotations[i], surface, radius, job);
        // For symmetric rooms the first rotation (identity) is preferred.
        if (best && mean >= least - 1e-6 * radius) continue;
        best = i;
        least = mean;
    }
    return rotations[best.value_or(0)];
}

/// The triangles of `part` that belong to one object, as a part of their own.
MeshPart pick(const MeshPart& part, const std::vector<std::size_t>& triangles) {
    MeshPart picked;
    picked.name = part.name;
    picked.material = part.material;
    std::unordered_map<std::uint32_t, std::uint32_t> renumbered;
    for (const std::size_t t : triangles) {
        Triangle moved = part.triangles[t];
        for (std::uint32_t& index : moved) {
            const auto [at, is_new] =
                renumbered.try_emplace(index, static_cast<std::uint32_t>(picked.positions.size()));
            if (is_new) {
                picked.positions.push_back(part.positions[index]);
                picked.normals.push_back(part.normals[index]);
                picked.uvs.push_back(part.uvs[index]);
            }
            index = at->second;
        }
        picked.triangles.push_back(moved);
    }
    measurePart(picked);
    return picked;
}

}  // namespace

RawScene transferLabels(RawScene labelled, RawScene textured, const JobContext& job) {
    constexpr double kReach = 0.02;  // largest distance of a label: share of the scene's diagonal
    const double radius = kReach * boundsOf(textured).diagonal().norm();
    const std::vector<SourceObject> objects = labelled.objects;
    const std::size_t none = objects.size();
    const LabelledSurface surface(labelled);
    const Eigen::Affine3d rotation =
        labelledFromTextured(boundsOf(labelled), textured, surface, radius, job);
    // The triangles of each part by object; sparse, since a part contains few of the objects.
    std::vector<std::map<std::size_t, std::vector<std::size_t>>> of_part(textured.parts.size());
    parallelFor(textured.parts.size(), [&](std::size_t p) {
        const MeshPart& part = textured.parts[p];
        for (std::size_t t = 0; t < part.triangles.size(); ++t) {
            if (t % 64 == 0 && job.cancelled()) return;
            const int object =
                surface.objectAt(cornersOf(part, part.triangles[t], rotation), radius);
            of_part[p][object > 0 ? static_cast<std::size_t>(object) - 1 : none].push_back(t);
        }
    });
    std::vector<std::vector<std::size_t>> parts_of(objects.size() + 1);
    for (std::size_t p = 0; p < of_part.size(); ++p) {
        for (const auto& entry : of_part[p]) parts_of[entry.first].push_back(p);
    }
    RawScene scene = std::move(textured);
    const std::vector<MeshPart> parts = std::move(scene.parts);
    scene.parts.clear();
    scene.nodes = {{"", -1, 0}};
    scene.objects.clear();
    std::size_t unlabelled = 0;
    for (std::size_t i = 0; i <= none; ++i) {
        SourceObject object;
        if (i < none) {
            object = objects[i];
        } else {
            object.name = "unlabelled surface";
            object.structure = true;
        }
        object.parts.clear();
        for (const std::size_t p : parts_of[i]) {
            const std::vector<std::size_t>& triangles = of_part[p].at(i);
            if (i == none) unlabelled += triangles.size();
            object.parts.push_back(scene.parts.size());
            scene.parts.push_back(pick(parts[p], triangles));
            scene.parts.back().node = static_cast<int>(scene.nodes.size());
        }
        if (object.parts.empty()) continue;
        scene.nodes.push_back({object.name, 0, 0});
        ++scene.nodes.front().children;
        scene.objects.push_back(std::move(object));
    }
    scene.notes.insert(scene.notes.end(), labelled.notes.begin(), labelled.notes.end());
    if (unlabelled > 0) {
        scene.notes.push_back(counted(unlabelled, "triangle has", "triangles have") +
                              " no labelled surface nearby");
    }
    return scene;
}

}  // namespace dollytrack::semantics
