#include "engine/document/unknown_keys.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace dollytrack {
namespace {

using nlohmann::json;

const json kNothing;

const json& at(const json& object, const std::string& key) {
    if (!object.is_object()) return kNothing;
    const auto found = object.find(key);
    return found == object.end() ? kNothing : *found;
}

/// An entry of one of the lists of `edits`.
struct Entry {
    const char* list;
    std::set<std::string> keys;  // known keys; one that is absent now was removed by an edit
};

const std::array<Entry, 6>& entries() {
    static const std::array<Entry, 6> kEntries = {{
        {"definitions", {"kind", "objects", "name", "nyu40", "min_size_m", "max_pieces"}},
        {"changes", {"object", "role", "nyu40", "front", "large", "move", "track"}},
        {"pinned", {"name", "position", "quaternion_xyzw", "objects"}},
        {"removed", {"objects"}},
        {"no_go", {"name", "center", "half_size_m", "yaw_rad"}},
        {"regions", {"name", "center", "half_size_m", "yaw_rad", "weight", "must_see"}},
    }};
    return kEntries;
}

/// Whether two references are to the same object: by name, and by number if both have one.
bool sameObject(const json& a, const json& b) {
    const json& id = at(a, "id");
    const json& other = at(b, "id");
    return at(a, "name") == at(b, "name") && (id.is_null() || other.is_null() || id == other);
}

/// Whether two entries of a list describe the same item.
bool sameEntry(const json& a, const json& b) {
    if (!sameObject(at(a, "object"), at(b, "object"))) return false;
    if (at(a, "name") != at(b, "name")) return false;
    if (!at(a, "name").is_null() && at(a, "kind").is_null()) return true;  // names are unique
    const json& objects = at(a, "objects");
    const json& others = at(b, "objects");
    // Manually written lists may have another order.
    return objects.size() == others.size() &&
           std::all_of(objects.begin(), objects.end(), [&](const json& one) {
               return std::any_of(others.begin(), others.end(),
                                  [&](const json& other) { return sameObject(one, other); });
           });
}

void copyUnknown(const json& from, const std::set<std::string>& known, json& into) {
    if (!from.is_object() || !into.is_object()) return;
    for (const auto& [key, value] : from.items()) {
        if (!known.contains(key) && !into.contains(key)) into[key] = value;
    }
}

void copyReferences(const json& from, json& into) {
    for (json& reference : into) {
        const auto same = std::find_if(from.begin(), from.end(), [&](const json& other) {
            return sameObject(reference, other);
        });
        if (same != from.end()) copyUnknown(*same, {"id", "name"}, reference);
    }
}

void copyEntry(const json& from, const Entry& entry, json& into) {
    copyUnknown(from, entry.keys, into);
    if (into.contains("object")) {
        copyUnknown(at(from, "object"), {"id", "name"}, into["object"]);
    }
    if (into.contains("objects")) copyReferences(at(from, "objects"), into["objects"]);
    if (into.contains("move")) {
        copyUnknown(at(from, "move"), {"offset_m", "turn_rad"}, into["move"]);
    }
    if (!into.contains("track")) return;
    const json& earlier_track = at(from, "track");
    for (json& key : into["track"]) {
        const auto same = std::find_if(
            earlier_track.begin(), earlier_track.end(),
            [&](const json& other) { return at(key, "time_s") == at(other, "time_s"); });
        if (same == earlier_track.end()) continue;
        copyUnknown(*same, {"time_s", "offset_m", "turn_rad"}, key);
    }
}

}  // namespace

void keepUnknownKeys(const json& earlier, json& section) {
    if (section.contains("motion") && sameEntry(section["motion"], at(earlier, "motion"))) {
        copyUnknown(at(earlier, "motion"), {"name", "frame_interval_s", "frames", "keys"},
                    section["motion"]);
    }
    for (const Entry& entry : entries()) {
        const json& old_list = at(earlier, entry.list);
        if (!old_list.is_array() || !at(section, entry.list).is_array()) continue;
        std::set<const json*> used;
        for (json& one : section[entry.list]) {
            const auto same = std::find_if(old_list.begin(), old_list.end(), [&](const json& old) {
                return !used.contains(&old) && sameEntry(one, old);
            });
            if (same == old_list.end()) continue;
            used.insert(&*same);
            copyEntry(*same, entry, one);
        }
    }
}

}  // namespace dollytrack
