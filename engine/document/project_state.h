#pragma once

#include "engine/document/edits.h"

#include <nlohmann/json.hpp>

namespace dollytrack {

/// What undo works on: everything of a project that a person decides.
struct ProjectState {
    nlohmann::json parameters = nlohmann::json::object();  // sections of fields
    Edits edits;
    bool operator==(const ProjectState&) const = default;
};

}  // namespace dollytrack
