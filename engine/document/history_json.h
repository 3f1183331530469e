#pragma once

#include "engine/core/result.h"
#include "engine/document/command_stack.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>

namespace dollytrack {

/// The undo steps as JSON, for the autosave of unsaved work: the first state in full, then the
/// difference made by each step, so that a hundred steps take little more room than one. If there
/// are more than `most` steps, the oldest are dropped, but never the current one.
nlohmann::json historyJson(const CommandStack::History& history, std::size_t most = 200);

/// Steps written before histories had import settings get null for these. Error: BadInput, naming
/// the step that cannot be applied.
Result<CommandStack::History> historyFromJson(const nlohmann::json& json);

}  // namespace dollytrack
