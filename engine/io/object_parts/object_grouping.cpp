#include "engine/io/object_parts/object_grouping.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace dollytrack {
namespace {

std::string lettersAndDigits(const std::string& text) {
    std::string plain;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) || byte >= 0x80) plain += static_cast<char>(std::tolower(byte));
    }
    return plain;
}

/// Determines for every node the node whose object its meshes belong to.
class NodeOwners {
  public:
    NodeOwners(const RawScene& raw, const LabelTable& labels) : raw_(raw) {
        for (const SourceNode& node : raw.nodes) labels_.push_back(labels.find(node.name));
        findRooms();
        owners_.resize(raw.nodes.size());
        for (std::size_t i = 0; i < raw.nodes.size(); ++i) {
            owners_[i] = static_cast<int>(i);
            const int parent = raw.nodes[i].parent;
            // The root node is the file, whatever its name.
            if (parent <= 0) continue;
            if (belongsTo(i, static_cast<std::size_t>(parent))) {
                owners_[i] = owners_[parent];
            }
        }
    }

    [[nodiscard]] int owner(int node) const { return owners_[node]; }
    [[nodiscard]] const Label& label(int node) const { return labels_[node]; }

  private:
    /// Marks nodes whose children have at least four classes of furniture: such a node is a room,
    /// not an object.
    void findRooms() {
        constexpr std::size_t kClasses = 4;
        std::vector<std::set<int>> classes(raw_.nodes.size());
        for (std::size_t i = 0; i < raw_.nodes.size(); ++i) {
            if (raw_.nodes[i].parent <= 0 || labels_[i].kind != LabelKind::Target) continue;
            classes[raw_.nodes[i].parent].insert(labels_[i].nyu40);
        }
        for (const std::set<int>& of_node : classes) {
            holds_room_.push_back(of_node.size() >= kClasses);
        }
    }

    [[nodiscard]] bool belongsTo(std::size_t child, std::size_t parent) const {
        const Label& child_label = labels_[child];
        const Label& parent_label = labels_[parent];
        const std::string inner = lettersAndDigits(raw_.nodes[child].name);
        // In an IFC model, a copy of a shape has this name, and the product around it the real one.
        if (inner.starts_with("ifcmappeditem")) return true;
        const std::string outer = lettersAndDigits(withoutNumber(raw_.nodes[parent].name));
        // "Sofa" contains "Sofa_wood_0" and "Shelf" contains "Shelf_mesh.001" as parts, but
        // "Kitchen" contains "Kitchen_table" as an object of its own.
        const bool same_start = outer.size() >= 3 && inner.starts_with(outer);
        if (same_start && holds_room_[parent]) return false;
        if (same_start && parent_label.kind != LabelKind::None) {
            return child_label.kind != LabelKind::Target || child_label.nyu40 == parent_label.nyu40;
        }
        if (same_start && child_label.kind != LabelKind::Target) return true;
        if (parent_label.kind != LabelKind::Target) return false;
        return child_label.kind == LabelKind::None || child_label.kind == LabelKind::Part ||
               child_label.kind == LabelKind::Weak;
    }

    const RawScene& raw_;
    std::vector<Label> labels_;
    std::vector<bool> holds_room_;
    std::vector<int> owners_;
};

bool isBlank(const std::string& name) {
    return std::all_of(name.begin(), name.end(),
                       [](char c) { return std::isspace(static_cast<unsigned char>(c)); });
}

}  // namespace

std::vector<ObjectDraft> draftsOfSource(const RawScene& raw, const LabelTable& labels) {
    std::vector<ObjectDraft> drafts;
    for (const SourceObject& object : raw.objects) {
        ObjectDraft draft;
        for (const std::size_t part : object.parts) {
            if (!raw.parts[part].triangles.empty()) draft.parts.push_back(part);
        }
        if (draft.parts.empty()) continue;
        draft.name =
            isBlank(object.name) ? "object_" + std::to_string(drafts.size() + 1) : object.name;
        draft.label = labels.find(object.category);
        if (draft.label.kind == LabelKind::None) draft.label = labels.find(object.name);
        if (object.nyu40 > 0) draft.label.nyu40 = object.nyu40;
        const bool by_word = object.nyu40 == 0 && draft.label.kind == LabelKind::Structure;
        draft.label.kind = object.structure || by_word ? LabelKind::Structure : LabelKind::Target;
        draft.front = object.front;
        drafts.push_back(std::move(draft));
    }
    return drafts;
}

std::vector<ObjectDraft> groupByNodes(const RawScene& raw, const LabelTable& labels,
                                      const std::vector<bool>& taken) {
    const NodeOwners owners(raw, labels);
    std::map<int, ObjectDraft> drafts;  // by owning node, and so in the file's order
    for (std::size_t i = 0; i < raw.parts.size(); ++i) {
        if (raw.parts[i].triangles.empty() || (i < taken.size() && taken[i])) continue;
        drafts[owners.owner(raw.parts[i].node)].parts.push_back(i);
    }
    std::vector<ObjectDraft> result;
    for (auto& [node, draft] : drafts) {
        draft.name = raw.nodes[node].name;
        draft.label = owners.label(node);
        // If the node's name has no meaning, the mesh's name may have one.
        const std::string& mesh_name = raw.parts[draft.parts.front()].name;
        if (draft.label.kind == LabelKind::None && !mesh_name.empty()) {
            const Label by_mesh = labels.find(mesh_name);
            if (by_mesh.kind != LabelKind::None) draft.label = by_mesh;
            if (isBlank(draft.name)) draft.name = mesh_name;
        }
        if (isBlank(draft.name)) draft.name = "object_" + std::to_string(result.size() + 1);
        result.push_back(std::move(draft));
    }
    return result;
}

Eigen::AlignedBox3f boundsOf(const RawScene& raw, const ObjectDraft& draft) {
    Eigen::AlignedBox3f box;
    for (const std::size_t part : draft.parts) box.extend(raw.parts[part].bounds);
    return box;
}

bool isMaterialNumber(const std::string& name) {
    const std::vector<std::string> words = wordsOfName(name);
    return words.empty() ||
           (words.size() == 1 && (words[0] == "mat" || words[0] == "material" ||
                                  words[0] == "default" || words[0].size() < 2)) ||
           name == "DefaultMaterial";
}

}  // namespace dollytrack
