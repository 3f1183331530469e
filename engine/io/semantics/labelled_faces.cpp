#include "engine/io/semantics/labelled_faces.h"

#include "engine/scene/labels.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace dollytrack::semantics {
namespace {

constexpr std::int64_t kNone = -1;

/// The number of each face: the one that two of its first three corners share, otherwise its first
/// corner's.
std::vector<std::int64_t> byCorners(const PlyMesh& mesh, const std::vector<std::int64_t>& numbers,
                                    const std::vector<std::size_t>& first) {
    std::vector<std::int64_t> faces(mesh.face_sizes.size(), kNone);
    const auto at = [&](std::size_t corner) {
        const std::uint32_t index = mesh.face_indices[corner];
        return index < numbers.size() ? numbers[index] : kNone;
    };
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (mesh.face_sizes[f] == 0) continue;
        faces[f] = at(first[f]);
        if (mesh.face_sizes[f] < 3) continue;
        const std::int64_t second = at(first[f] + 1);
        if (second == at(first[f] + 2)) faces[f] = second;
    }
    return faces;
}

std::vector<std::int64_t> objectsOf(const PlyMesh& mesh, const LabelNames& names,
                                    const std::vector<std::size_t>& first) {
    if (!names.segments.empty() && !names.of_segment.empty()) {
        std::vector<std::int64_t> objects(names.segments.size(), kNone);
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const auto found = names.of_segment.find(names.segments[i]);
            if (found != names.of_segment.end()) objects[i] = found->second;
        }
        return byCorners(mesh, objects, first);
    }
    if (!mesh.face_objects.empty()) return mesh.face_objects;
    if (!mesh.position_objects.empty()) return byCorners(mesh, mesh.position_objects, first);
    return {};
}

std::vector<std::int64_t> classesOf(const PlyMesh& mesh, const std::vector<std::size_t>& first) {
    if (!mesh.face_classes.empty()) return mesh.face_classes;
    if (!mesh.position_classes.empty()) return byCorners(mesh, mesh.position_classes, first);
    return {};
}

/// Connected components of faces with the same class; faces are connected if they share a position.
class Pieces {
  public:
    Pieces(const PlyMesh& mesh, const std::vector<std::size_t>& first,
           const std::vector<std::int64_t>& classes)
        : parent_(classes.size()) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        std::map<std::pair<std::uint32_t, std::int64_t>, std::size_t> seen;
        for (std::size_t f = 0; f < classes.size(); ++f) {
            for (std::size_t i = 0; i < mesh.face_sizes[f]; ++i) {
                const auto [at, is_new] =
                    seen.try_emplace({mesh.face_indices[first[f] + i], classes[f]}, f);
                if (!is_new) parent_[root(f)] = root(at->second);
            }
        }
    }

    std::size_t root(std::size_t face) {
        while (parent_[face] != face) {
            parent_[face] = parent_[parent_[face]];
            face = parent_[face];
        }
        return face;
    }

  private:
    std::vector<std::size_t> parent_;
};

int nyuOf(std::int64_t number) {
    return number >= 1 && number <= kNyu40Count ? static_cast<int>(number) : 0;
}

/// The most frequent NYU40 class among the faces of each object.
std::map<std::int64_t, int> majorityClasses(const std::vector<std::int64_t>& objects,
                                            const std::vector<std::int64_t>& classes) {
    std::map<std::int64_t, std::map<int, std::size_t>> counts;
    for (std::size_t f = 0; f < objects.size() && f < classes.size(); ++f) {
        if (nyuOf(classes[f]) > 0) ++counts[objects[f]][nyuOf(classes[f])];
    }
    std::map<std::int64_t, int> majority;
    for (const auto& [object, of] : counts) {
        majority[object] =
            std::ranges::max_element(of, {}, [](const auto& entry) { return entry.second; })->first;
    }
    return majority;
}

LabelledFaces byObjects(const std::vector<std::int64_t>& objects,
                        const std::vector<std::int64_t>& classes, const LabelNames& names,
                        bool nyu40) {
    const std::map<std::int64_t, int> majority =
        nyu40 ? majorityClasses(objects, classes) : std::map<std::int64_t, int>{};
    // Negative numbers, and those missing in a file of names, mean unlabelled.
    constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
    const auto numberOf = [&](std::int64_t number) {
        const bool any = names.categories.empty() || names.categories.contains(number);
        return number >= 0 && any ? number : kLast;
    };
    // In increasing order of the numbers, independent of the order of faces; unlabelled is last.
    std::map<std::int64_t, std::size_t> index;
    for (const std::int64_t number : objects) index.try_emplace(numberOf(number), 0);
    LabelledFaces labelled;
    labelled.classes_are_nyu40 = nyu40;
    for (auto& [number, at] : index) {
        at = labelled.objects.size();
        LabelledObject object;
        object.target = number != kLast;
        if (object.target) object.number = number;
        const auto known = names.categories.find(number);
        if (known != names.categories.end()) object.category = known->second;
        if (const auto found = majority.find(number); found != majority.end()) {
            object.nyu40 = found->second;
        }
        labelled.objects.push_back(std::move(object));
    }
    labelled.of_face.reserve(objects.size());
    for (const std::int64_t number : objects) {
        labelled.of_face.push_back(index.at(numberOf(number)));
    }
    return labelled;
}

LabelledFaces byClasses(const PlyMesh& mesh, const std::vector<std::size_t>& first,
                        const std::vector<std::int64_t>& classes, const LabelNames& names,
                        bool nyu40) {
    constexpr std::size_t kSpeck = 50;  // faces
    Pieces pieces(mesh, first, classes);
    std::map<std::size_t, std::size_t> sizes;
    for (std::size_t f = 0; f < classes.size(); ++f) ++sizes[pieces.root(f)];
    LabelledFaces labelled;
    labelled.classes_are_nyu40 = nyu40;
    std::map<std::pair<std::int64_t, std::size_t>, std::size_t> index;
    constexpr std::size_t kSpecks = -1;
    std::map<std::int64_t, std::size_t> largest;
    for (std::size_t f = 0; f < classes.size(); ++f) {
        std::size_t& most = largest[classes[f]];
        most = std::max(most, sizes[pieces.root(f)]);
    }
    for (std::size_t f = 0; f < classes.size(); ++f) {
        const std::int64_t number = classes[f];
        const bool labelled_at_all = nyu40 ? nyuOf(number) > 0 : number >= 0;
        std::size_t piece = pieces.root(f);
        const bool speck = sizes[piece] < std::min(kSpeck, largest[number]);
        if (speck || !labelled_at_all) piece = kSpecks;
        const auto [at, is_new] =
            index.try_emplace({labelled_at_all ? number : kNone, piece}, labelled.objects.size());
        labelled.of_face.push_back(at->second);
        if (!is_new) continue;
        LabelledObject object;
        object.target = piece != kSpecks;
        if (nyu40) object.nyu40 = nyuOf(number);
        const auto known = names.categories.find(number);
        if (known != names.categories.end()) {
            object.category = known->second;
        } else if (labelled_at_all && !nyu40) {
            object.category = "class " + std::to_string(number);
        }
        labelled.objects.push_back(std::move(object));
    }
    return labelled;
}

}  // namespace

std::optional<LabelledFaces> labelFaces(const PlyMesh& mesh, const LabelNames& names) {
    // The class numbers of faces are preferred, as in classesOf().
    const bool nyu40 =
        mesh.face_classes.empty() ? mesh.position_classes_are_nyu40 : mesh.face_classes_are_nyu40;
    const std::vector<std::size_t> first = firstIndices(mesh);
    const std::vector<std::int64_t> objects = objectsOf(mesh, names, first);
    const std::vector<std::int64_t> classes = classesOf(mesh, first);
    const std::size_t count = mesh.face_sizes.size();
    if (objects.size() == count && count > 0) return byObjects(objects, classes, names, nyu40);
    if (classes.size() == count && count > 0) return byClasses(mesh, first, classes, names, nyu40);
    return std::nullopt;
}

}  // namespace dollytrack::semantics
