#include "app/gather/sources/class_union.h"

#include "engine/core/name_hint.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace dollytrack::gather {
namespace {

/// The objects that a class of a label file matches.
struct Meaning {
    std::vector<std::string> patterns;
    bool is_other = false;  // the class of objects that match no class
    bool operator==(const Meaning&) const = default;
};

Meaning meaningOf(const ClassTable& table, const DatasetClass& one) {
    const std::size_t index = table.indexOf(one);
    return {table.rules()[index].patterns, table.other() == index};
}

/// Describes a contradiction between two tables, as "here" and "there"; empty if there is none.
std::string contradiction(const ClassTable& here, const ClassTable& there) {
    if (here.isNyu40() != there.isNyu40()) {
        return fmt::format("its classes are {} here and {} there",
                           here.isNyu40() ? "NYU40's" : "of an own table",
                           there.isNyu40() ? "NYU40's" : "of an own table");
    }
    if (here.isNyu40()) return {};
    for (const DatasetClass& one : here.classes()) {
        if (const DatasetClass* other = there.find(one.id); other && other->name != one.name) {
            return fmt::format("class {} is '{}' here and '{}' there", one.id, one.name,
                               other->name);
        }
        const auto named = std::ranges::find(there.classes(), one.name, &DatasetClass::name);
        if (named == there.classes().end()) continue;
        if (named->id != one.id) {
            return fmt::format("class '{}' has id {} here and {} there", one.name, one.id,
                               named->id);
        }
        if (meaningOf(here, one) != meaningOf(there, *named)) {
            return fmt::format("class '{}' matches other objects here than there", one.name);
        }
    }
    const DatasetClass* of_void = there.find(here.voidClass().id);
    if (of_void != nullptr && of_void != &there.voidClass()) {
        return fmt::format("class {} is void here and '{}' there", of_void->id, of_void->name);
    }
    return {};
}

/// One dataset for each distinct table.
std::vector<const Source*> oneOfEachTable(std::span<const Source> sources) {
    std::vector<const Source*> kinds;
    std::set<const ClassTable*> seen;
    for (const Source& source : sources) {
        if (seen.insert(&source.classes()).second) kinds.push_back(&source);
    }
    return kinds;
}

Status checkTables(const std::vector<const Source*>& kinds) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const std::string what = contradiction(kinds[i]->classes(), kinds[j]->classes());
            if (what.empty()) continue;
            return fail(ErrorCode::BadInput,
                        fmt::format("The class tables contradict each other: {}, in {}; map the "
                                    "classes with --class-map, or gather the datasets separately.",
                                    what, kinds[j]->folder.string()),
                        kinds[i]->folder.string());
        }
    }
    return {};
}

Status checkMap(const ClassMap& map, const std::vector<const Source*>& kinds) {
    std::vector<std::string> names;
    for (const Source* kind : kinds) {
        for (const DatasetClass& one : kind->classes().classes()) names.push_back(one.name);
    }
    for (const auto& [from, to] : map) {
        if (std::ranges::find(names, from) != names.end()) continue;
        return fail(ErrorCode::BadInput,
                    fmt::format("No dataset has a class '{}'{}", from, nameHint(from, names)),
                    "--class-map");
    }
    return {};
}

}  // namespace

const std::string& ClassUnion::nameOf(const DatasetClass& one) const {
    if (!map_) return one.name;
    const auto found = map_->find(one.name);
    return found == map_->end() ? one.name : found->second;
}

std::optional<std::size_t> ClassUnion::find(const std::string& name) const {
    const auto found = std::ranges::find(classes_, name, &GatheredClass::name);
    if (found == classes_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - classes_.begin());
}

Result<ClassUnion> ClassUnion::of(std::span<const Source> sources,
                                  const std::optional<ClassMap>& map) {
    ClassUnion all;
    all.map_ = map;
    const std::vector<const Source*> kinds = oneOfEachTable(sources);
    if (Status checked = map ? checkMap(*map, kinds) : checkTables(kinds); !checked) {
        return tl::unexpected(checked.error());
    }
    for (const Source* kind : kinds) {
        for (const DatasetClass& one : kind->classes().classes()) {
            const std::string& name = all.nameOf(one);
            if (all.find(name)) continue;
            const int id = map ? static_cast<int>(all.classes_.size()) + 1 : one.id;
            all.classes_.push_back({id, name, one.supercategory});
        }
    }
    return all;
}

std::size_t ClassUnion::indexOf(const DatasetClass& one) const {
    return find(nameOf(one)).value_or(0);
}

std::vector<std::string> ClassUnion::missingIn(const Source& source) const {
    std::set<std::string> own;
    for (const DatasetClass& one : source.classes().classes()) own.insert(nameOf(one));
    std::vector<std::string> missing;
    for (const GatheredClass& one : classes_) {
        if (!own.contains(one.name)) missing.push_back(one.name);
    }
    return missing;
}

}  // namespace dollytrack::gather
