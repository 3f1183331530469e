#pragma once

#include "engine/core/result.h"
#include "engine/document/command_stack.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>

namespace dollytrack {

/// Undo's steps as JSON, for a copy of unsaved work: the first state whole, of each later one what
/// it changes, so that a hundred steps take little more room than one. Of more than `most` steps
/// the oldest are left away, but never the one at which one is.
nlohmann::json historyJson(const CommandStack::History& history, std::size_t most = 200);

/// Error: BadInput with the step that does not fit.
Result<CommandStack::History> historyFromJson(const nlohmann::json& json);

}  // namespace dollytrack
