#include "engine/core/disjoint_sets.h"
#include "engine/document/change_descriptions.h"
#include "engine/document/operation_table.h"
#include "engine/document/regroup.h"
#include "engine/geometry/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <span>

namespace dollytrack {
namespace {

constexpr double kTouch_m = 0.005;  // largest gap between parts of one object
constexpr std::size_t kMostGrouped = 5'000;

/// For each object of the scene before a definition (index id - 1), its object after it, or several
/// if it was split.
using Successors = std::vector<std::vector<ObjectRef>>;

void follow(std::vector<ObjectRef>& objects, const Scene& before, const Successors& successors) {
    std::vector<ObjectRef> next;
    for (const ObjectRef& ref : objects) {
        const int id = findObject(before, ref);
        if (id == 0) {
            next.push_back(ref);  // does not exist in the scene; kept unchanged
            continue;
        }
        const auto& made = successors[id - 1];
        next.insert(next.end(), made.begin(), made.end());
    }
    std::sort(next.begin(), next.end(),
              [](const ObjectRef& a, const ObjectRef& b) { return a.id < b.id; });
    next.erase(std::unique(next.begin(), next.end()), next.end());
    objects = std::move(next);
}

/// Updates all references to objects in the edits to the objects after the definition.
void followAll(Edits& edits, const Scene& before, const Successors& successors) {
    std::vector<ObjectChange> changes;
    for (const ObjectChange& change : edits.scene.changes) {
        std::vector<ObjectRef> refs = {change.object};
        follow(refs, before, successors);
        for (const ObjectRef& ref : refs) {
            ObjectChange next = change;
            next.object = ref;
            // The front of the whole object does not apply to its pieces.
            if (refs.size() > 1) next.front.reset();
            if (refs.size() > 1) next.large.reset();
            if (!next.saysNothing()) changes.push_back(std::move(next));
        }
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const auto& a, const auto& b) { return a.object.id < b.object.id; });
    edits.scene.changes = std::move(changes);
    for (PinnedPoint& pinned : edits.plan.pinned) follow(pinned.objects, before, successors);
    for (RemovedPoint& removed : edits.plan.removed) follow(removed.objects, before, successors);
}

/// Refuses moved objects: a new object is made from its parts' positions in the file, so it would
/// jump back.
void refuseMoved(const ProjectState& state, const OperationContext& context,
                 const std::vector<ObjectRef>& objects, const JsonReader& where) {
    for (const ObjectChange& change : state.edits.scene.changes) {
        const int id = findObject(context.scene, change.object);
        if ((!change.move && change.track.empty()) || id == 0) continue;
        if (std::ranges::find(objects, id, &ObjectRef::id) == objects.end()) continue;
        where.refuse(fmt::format(
            "'{}' was moved, or has a track; undo that first (move_object with offset [0, 0, 0] "
            "and turn_deg 0, object_track without keys), and move the result.",
            change.object.name));
    }
}

bool isTaken(const Scene& scene, const std::string& name, const std::vector<ObjectRef>& but) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return object.name == name &&
               std::none_of(but.begin(), but.end(),
                            [&](const ObjectRef& ref) { return ref.id == object.id; });
    });
}

struct SplitCount {
    std::size_t pieces = 0;
    std::size_t joined = 0;  // connected pieces that are joined to another piece
    double smallest_m = std::numeric_limits<double>::infinity();
};

/// Splits an object in `scene` and in the state of that scene. Returns false if it cannot be split.
bool splitOne(ProjectState& state, Scene& scene, const ObjectRef& object, const SplitLimits& limits,
              SplitCount& count) {
    const std::vector<TriangleList> pieces = findPieces(scene, scene.object(object.id), limits);
    if (pieces.size() < 2) return false;
    const std::vector<double> sizes = pieceSizes(scene, scene.object(object.id));
    count.pieces += pieces.size();
    count.joined += sizes.size() - pieces.size();
    count.smallest_m = std::min(count.smallest_m, sizes[pieces.size() - 1]);
    const std::vector<std::string> names = pieceNames(scene, object.name, pieces.size());
    Successors successors;
    int next = 1;
    for (const Object& other : scene.objects) {
        std::vector<ObjectRef>& made = successors.emplace_back();
        if (other.id != object.id) {
            made.push_back({next++, other.name});
            continue;
        }
        for (const std::string& name : names) made.push_back({next++, name});
    }
    followAll(state.edits, scene, successors);
    state.edits.scene.definitions.push_back(
        {ObjectDefinition::Kind::Split, {object}, object.name, 0, limits});
    splitObject(scene, object.id, pieces, names);
    return true;
}

const ObjectRef& largestOf(const Scene& scene, const std::vector<ObjectRef>& parts) {
    return *std::ranges::max_element(
        parts, {}, [&](const ObjectRef& ref) { return scene.object(ref.id).box.volume(); });
}

/// Adds a definition to the state that merges several objects of `scene`, and returns their
/// successors. `scene` is not changed.
Successors mergeOne(ProjectState& state, const Scene& scene, ObjectDefinition definition) {
    // The class includes changes of class, which are applied after definitions.
    if (definition.nyu40 == 0) {
        definition.nyu40 = scene.object(largestOf(scene, definition.objects).id).nyu40;
    }
    const auto isPart = [&](int id) {
        return std::ranges::find(definition.objects, id, &ObjectRef::id) !=
               definition.objects.end();
    };
    // Edits of the parts do not apply to the merged object.
    std::erase_if(state.edits.scene.changes, [&](const ObjectChange& change) {
        return isPart(findObject(scene, change.object));
    });
    Successors successors;
    const int first = definition.objects.front().id;
    int next = 1;
    for (const Object& object : scene.objects) {
        const bool part = isPart(object.id);
        if (part && object.id != first) {
            successors.push_back({{first, definition.name}});
            continue;
        }
        successors.push_back({{next++, part ? definition.name : object.name}});
    }
    followAll(state.edits, scene, successors);
    state.edits.scene.definitions.push_back(std::move(definition));
    return successors;
}

/// Groups of two or more objects connected by gaps of at most `gap_m`, in order of id.
std::vector<std::vector<ObjectRef>> findGroups(const Scene& scene,
                                               const std::vector<ObjectRef>& objects,
                                               double gap_m) {
    struct Part {
        std::vector<SurfaceView> surfaces;
        Eigen::AlignedBox3f bounds;
    };
    const auto gap = static_cast<float>(gap_m);
    std::vector<Part> parts;
    for (const ObjectRef& ref : objects) {
        const Object& object = scene.object(ref.id);
        const std::span triangles(scene.triangles.begin() + object.first_triangle,
                                  static_cast<std::size_t>(object.triangle_count));
        Part part{{{scene.positions, triangles}}, {}};
        for (const Triangle& triangle : triangles) {
            for (const std::uint32_t corner : triangle) part.bounds.extend(scene.positions[corner]);
        }
        parts.push_back(std::move(part));
    }
    DisjointSets connected(parts.size());
    // Only objects whose extents along x overlap are compared.
    std::vector<std::size_t> by_x(parts.size());
    std::iota(by_x.begin(), by_x.end(), std::size_t{0});
    std::ranges::stable_sort(by_x, {}, [&](std::size_t i) { return parts[i].bounds.min().x(); });
    for (std::size_t k = 0; k < by_x.size(); ++k) {
        const Part& a = parts[by_x[k]];
        for (std::size_t m = k + 1; m < by_x.size(); ++m) {
            const Part& b = parts[by_x[m]];
            if (b.bounds.min().x() > a.bounds.max().x() + gap) break;
            if (connected.find(by_x[k]) == connected.find(by_x[m])) continue;
            if (a.bounds.exteriorDistance(b.bounds) > gap) continue;
            if (findContact(a.surfaces, b.surfaces, gap).empty()) continue;
            connected.join(by_x[k], by_x[m]);
        }
    }
    std::map<std::size_t, std::vector<ObjectRef>> by_first;
    for (std::size_t i = 0; i < parts.size(); ++i)
        by_first[connected.find(i)].push_back(objects[i]);
    std::vector<std::vector<ObjectRef>> groups;
    for (auto& [first, group] : by_first) {
        if (group.size() > 1) groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace

std::string merge(ProjectState& state, const OperationContext& context,
                  const OperationReader& fields) {
    const Scene& scene = context.scene;
    ObjectDefinition definition;
    definition.objects = fields.objects("objects");
    definition.name = fields.field("name").text();
    if (fields.has("class")) definition.nyu40 = fields.nyu40("class");
    if (fields.good() && definition.objects.size() < 2) {
        fields.field("objects").refuse("Merging needs at least two objects.");
    }
    if (fields.good()) {
        refuseMoved(state, context, definition.objects, fields.field("objects"));
    }
    if (fields.good() && definition.name.empty()) {
        fields.field("name").refuse("The new object needs a name.");
    }
    if (fields.good() && isTaken(scene, definition.name, definition.objects)) {
        fields.field("name").refuse(fmt::format(
            "Another object is already called '{}'; choose another name.", definition.name));
    }
    if (!fields.good()) return {};
    std::string name =
        fmt::format("Make {} of {}", definition.name, describeObjects(definition.objects));
    mergeOne(state, scene, std::move(definition));
    return name;
}

std::string group(ProjectState& state, const OperationContext& context,
                  const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objectsOrClass("object");
    const JsonReader said = fields.field(fields.has("object") ? "object" : "class");
    const std::string name = fields.has("name") ? fields.field("name").text() : "";
    const double gap_m = fields.has("gap_m") ? fields.field("gap_m").number(0.0, 10.0) : kTouch_m;
    if (fields.good() && objects.size() > kMostGrouped) {
        said.refuse(fmt::format("{} objects are selected; group at most {} at a time.",
                                objects.size(), kMostGrouped));
    }
    if (fields.good()) refuseMoved(state, context, objects, said);
    if (!fields.good()) return {};
    std::vector<std::vector<ObjectRef>> groups = findGroups(context.scene, objects, gap_m);
    if (groups.empty()) {
        said.refuse(
            fmt::format("No two of these {} objects are within {} m of each other; raise "
                        "gap_m.",
                        objects.size(), gap_m));
        return {};
    }
    Scene scene = context.scene;
    std::vector<std::string> names;
    if (!name.empty()) names = pieceNames(scene, name, groups.size());
    std::size_t parts = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        parts += groups[i].size();
        const std::string largest = scene.object(largestOf(scene, groups[i]).id).name;
        const Successors successors =
            mergeOne(state, scene,
                     {ObjectDefinition::Kind::Merge,
                      groups[i],
                      !names.empty()                       ? names[i]
                      : isTaken(scene, largest, groups[i]) ? pieceNames(scene, largest, 1)[0]
                                                           : largest,
                      0,
                      {}});
        std::vector<int> ids;
        for (const ObjectRef& ref : groups[i]) ids.push_back(ref.id);
        const ObjectDefinition& made = state.edits.scene.definitions.back();
        for (std::size_t k = i + 1; k < groups.size(); ++k) follow(groups[k], scene, successors);
        mergeObjects(scene, ids, made.name, made.nyu40);
    }
    return fmt::format("Make {} objects of {}", groups.size(), parts);
}

std::string split(ProjectState& state, const OperationContext& context,
                  const OperationReader& fields) {
    const std::vector<ObjectRef> objects = fields.objectsOrClass("object");
    const SplitLimits limits = fields.splitLimits();
    const JsonReader said = fields.field(fields.has("object") ? "object" : "class");
    if (fields.good()) refuseMoved(state, context, objects, said);
    if (!fields.good()) return {};
    Scene scene = context.scene;
    SplitCount count;
    std::vector<ObjectRef> done;
    // A split changes the numbers of later objects, so the last object is split first.
    for (auto object = objects.rbegin(); object != objects.rend(); ++object) {
        if (splitOne(state, scene, *object, limits, count)) done.insert(done.begin(), *object);
    }
    if (done.empty()) {
        said.refuse(limits == SplitLimits{}
                        ? fmt::format("'{}' is one connected piece and cannot be split.",
                                      objects.front().name)
                        : fmt::format("'{}' has no two pieces within these limits; lower "
                                      "min_size_m.",
                                      objects.front().name));
        return {};
    }
    return fmt::format(
        "Split {} into {} pieces, the smallest {:.3g} m{}", describeObjects(done), count.pieces,
        count.smallest_m,
        count.joined == 0 ? "" : fmt::format(", {} smaller ones with the nearest", count.joined));
}

}  // namespace dollytrack
