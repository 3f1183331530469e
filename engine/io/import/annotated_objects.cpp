#include "engine/io/import/annotated_objects.h"

#include "engine/core/name_hint.h"

#include <algorithm>
#include <map>
#include <set>

namespace dollytrack {
namespace {

const std::string& nodeNameOf(const RawScene& raw, const MeshPart& part) {
    return raw.nodes[part.node].name;
}

bool isBelow(const RawScene& raw, int node, const std::string& name) {
    for (; node >= 0; node = raw.nodes[node].parent) {
        if (raw.nodes[node].name == name) return true;
    }
    return false;
}

/// A new part with the triangles for which `chosen` equals `want`, and with their vertices.
MeshPart partOf(const MeshPart& whole, const std::vector<bool>& chosen, bool want) {
    MeshPart part;
    part.name = whole.name;
    part.node = whole.node;
    part.material = whole.material;
    std::map<std::uint32_t, std::uint32_t> moved;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        if (chosen[t] != want) continue;
        Triangle triangle = whole.triangles[t];
        for (std::uint32_t& corner : triangle) {
            const auto [found, is_new] =
                moved.try_emplace(corner, static_cast<std::uint32_t>(part.positions.size()));
            if (is_new) {
                part.positions.push_back(whole.positions[corner]);
                part.normals.push_back(whole.normals[corner]);
                part.uvs.push_back(whole.uvs[corner]);
                part.bounds.extend(whole.positions[corner]);
            }
            corner = found->second;
        }
        part.triangles.push_back(triangle);
    }
    // Areas are needed only to estimate the up axis of the whole scene, so shares are sufficient.
    const double share = static_cast<double>(part.triangles.size()) /
                         static_cast<double>(std::max<std::size_t>(1, whole.triangles.size()));
    part.area = share * whole.area;
    for (std::size_t i = 0; i < part.facing_area.size(); ++i) {
        part.facing_area[i] = share * whole.facing_area[i];
    }
    return part;
}

class Taker {
  public:
    Taker(RawScene& raw, AnnotatedDrafts& result) : raw_(raw), result_(result) {
        result_.taken.assign(raw_.parts.size(), false);
    }

    void take(const AnnotatedObject& object, ObjectDraft& draft) {
        // Ranges first, because they refer to triangles of the whole mesh.
        for (const AnnotatedTriangles& range : object.triangles) cut(range, object, draft);
        for (const std::string& name : object.nodes) {
            takeWhere(object, draft, "node", name,
                      [&](const MeshPart& part) { return isBelow(raw_, part.node, name); });
        }
        for (const std::string& name : object.meshes) {
            takeWhere(object, draft, "mesh", name,
                      [&](const MeshPart& part) { return part.name == name; });
        }
    }

    /// Finds the meshes that have ranges of any object.
    void noteRanges(const std::vector<AnnotatedObject>& objects) {
        for (const AnnotatedObject& object : objects) {
            for (const AnnotatedTriangles& range : object.triangles) meshes_.insert(range.mesh);
        }
        const std::size_t parts = raw_.parts.size();
        for (std::size_t i = 0; i < parts; ++i) {
            const MeshPart& part = raw_.parts[i];
            if (!meshes_.contains(part.name) && !meshes_.contains(nodeNameOf(raw_, part))) continue;
            left_[i] = std::vector<bool>(part.triangles.size(), true);
        }
    }

    /// Keeps the triangles outside all ranges in their mesh.
    void finishRanges() {
        for (const auto& [index, left] : left_) {
            if (result_.taken[index]) continue;
            if (std::find(left.begin(), left.end(), false) == left.end()) continue;
            raw_.parts[index] = partOf(raw_.parts[index], left, true);
        }
    }

  private:
    template <class Wanted>
    void takeWhere(const AnnotatedObject& object, ObjectDraft& draft, const char* kind,
                   const std::string& name, Wanted&& wanted) {
        bool any = false;
        for (std::size_t i = 0; i < raw_.parts.size(); ++i) {
            if (!wanted(raw_.parts[i])) continue;
            any = true;
            // Meshes with ranges cannot be taken as a whole, and no mesh twice.
            if (result_.taken[i] || left_.contains(i) || raw_.parts[i].triangles.empty()) continue;
            result_.taken[i] = true;
            draft.parts.push_back(i);
        }
        if (!any) missing(object, kind, name);
    }

    void cut(const AnnotatedTriangles& range, const AnnotatedObject& object, ObjectDraft& draft) {
        bool any = false;
        std::size_t first = range.first;
        std::size_t count = range.count;
        for (auto& [index, left] : left_) {
            const MeshPart& part = raw_.parts[index];
            if (part.name != range.mesh && nodeNameOf(raw_, part) != range.mesh) continue;
            any = true;
            // A mesh with several materials has several parts, which are numbered consecutively.
            const std::size_t here = left.size();
            if (first >= here) {
                first -= here;
                continue;
            }
            const std::size_t end = first + std::min(count, here - first);
            std::vector<bool> chosen(here, false);
            for (std::size_t t = first; t < end; ++t) {
                chosen[t] = left[t];
                left[t] = false;
            }
            count -= end - first;
            first = 0;
            MeshPart piece = partOf(part, chosen, true);
            if (!piece.triangles.empty()) {
                draft.parts.push_back(raw_.parts.size());
                raw_.parts.push_back(std::move(piece));
                result_.taken.push_back(true);
            }
            if (count == 0) break;
        }
        if (!any) {
            missing(object, "mesh", range.mesh);
        } else if (count > 0) {
            result_.warnings.push_back("annotations: \"" + range.mesh + "\" has fewer triangles " +
                                       "than \"" + object.name + "\" names");
        }
    }

    void missing(const AnnotatedObject& object, const char* kind, const std::string& name) {
        std::string hint;
        // Limited, because a hint compares the name with all names in the scene.
        if (++missing_ <= kMostHints) {
            std::vector<std::string> names;
            for (const MeshPart& part : raw_.parts) names.push_back(part.name);
            for (const SourceNode& node : raw_.nodes) names.push_back(node.name);
            hint = nameHint(name, names);
        }
        result_.warnings.push_back(std::string("annotations: there is no ") + kind + " \"" + name +
                                   "\" for \"" + object.name + "\"" + hint);
    }

    static constexpr std::size_t kMostHints = 10;

    RawScene& raw_;
    AnnotatedDrafts& result_;
    std::size_t missing_ = 0;
    std::set<std::string> meshes_;                   // meshes with ranges
    std::map<std::size_t, std::vector<bool>> left_;  // by part: triangles outside all ranges so far
};

/// The label of an annotated object: by its class, otherwise by the most specific of its name and
/// the names of its nodes and meshes.
Label labelOf(const AnnotatedObject& object, const LabelTable& labels,
              std::vector<std::string>& warnings) {
    if (!object.category.empty()) {
        const Label said = labels.find(object.category);
        if (said.kind == LabelKind::None && !object.nyu40) {
            warnings.push_back("annotations: \"" + object.category + "\", the class of \"" +
                               object.name + "\", is unknown; add it with --labels, or give nyu40");
        }
        return said;
    }
    std::vector<std::string> names = {object.name};
    names.insert(names.end(), object.nodes.begin(), object.nodes.end());
    names.insert(names.end(), object.meshes.begin(), object.meshes.end());
    const std::string* best = labels.mostTelling(names);
    return best != nullptr ? labels.find(*best) : Label{};
}

}  // namespace

AnnotatedDrafts takeAnnotated(const std::vector<AnnotatedObject>& objects, const LabelTable& labels,
                              RawScene& raw) {
    AnnotatedDrafts result;
    Taker taker(raw, result);
    taker.noteRanges(objects);
    for (const AnnotatedObject& object : objects) {
        ObjectDraft draft;
        taker.take(object, draft);
        if (draft.parts.empty()) {
            result.warnings.push_back("annotations: no triangles are left for \"" + object.name +
                                      "\", so it is not an object");
            continue;
        }
        draft.name = object.name;
        draft.label = labelOf(object, labels, result.warnings);
        if (object.nyu40) draft.label.nyu40 = *object.nyu40;
        draft.label.kind = object.structure ? LabelKind::Structure : LabelKind::Target;
        draft.front = object.front;
        result.drafts.push_back(std::move(draft));
    }
    taker.finishRanges();
    return result;
}

}  // namespace dollytrack
