#pragma once

#include "engine/core/field_list.h"
#include "engine/document/operation_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// Shared by operations on lists of named entries.

namespace dollytrack {

/// Finds an entry by its name. If there is none, returns end() and records an error that suggests
/// the closest name.
template <class Entry>
auto findNamed(std::vector<Entry>& entries, const JsonReader& from, std::string_view what) {
    const std::string name = from.text();
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    if (found != entries.end()) return found;
    std::vector<std::string> names;
    for (const Entry& entry : entries) names.push_back(entry.name);
    const std::string close = closestName(name, names);
    from.refuse(close.empty()
                    ? fmt::format("There is no {} '{}'.", what, name)
                    : fmt::format("There is no {} '{}'; did you mean '{}'?", what, name, close));
    return entries.end();
}

template <class Entry>
bool isTaken(const std::vector<Entry>& entries, const std::string& name) {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const Entry& entry) { return entry.name == name; });
}

/// The name for a new entry: the one in the field "name", which no entry may have yet, or without
/// this field `base`, followed by a number if that name is taken. Records an error if the list is
/// full (kMostPlanEntries).
/// @param what  the kind of entries for that error, such as "no-go boxes"
template <class Entry>
std::string freeName(const std::vector<Entry>& entries, const OperationReader& fields,
                     const std::string& base, std::string_view what) {
    if (entries.size() >= kMostPlanEntries) {
        fields.refuse(fmt::format("There are {} {}, the most that are possible; remove one first.",
                                  entries.size(), what));
        return {};
    }
    if (fields.has("name")) {
        const JsonReader from = fields.field("name");
        std::string name = from.text();
        if (from.good() && name.empty()) from.refuse("A name must not be empty.");
        if (isTaken(entries, name)) {
            from.refuse(fmt::format("The name '{}' is already used; choose another one.", name));
        }
        return name;
    }
    // Asking all entries for each number would take hours for a script of thousands of additions.
    std::set<std::string_view> taken;
    for (const Entry& entry : entries) {
        if (entry.name.starts_with(base)) taken.insert(entry.name);
    }
    std::string name = base;
    for (int number = 2; taken.contains(name); ++number) {
        name = fmt::format("{} {}", base, number);
    }
    return name;
}

}  // namespace dollytrack
