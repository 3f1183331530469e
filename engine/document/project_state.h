#pragma once

#include "engine/document/edits.h"

#include <nlohmann/json.hpp>

namespace dollytrack {

/// The state that undo restores: everything in a project that the user decides.
struct ProjectState {
    nlohmann::json parameters = nlohmann::json::object();  // sections of fields
    nlohmann::json import = nlohmann::json::object();      // see import_settings.h
    Edits edits;
    bool operator==(const ProjectState&) const = default;
};

}  // namespace dollytrack
