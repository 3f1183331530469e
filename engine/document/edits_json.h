#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/document/json_reader.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack {

/// The section `edits` of a project file; an empty object for no edits. `loaded` is the section as
/// it was read: its keys that this version does not know are kept.
nlohmann::json editsJson(const Edits& edits, const nlohmann::json& loaded);
nlohmann::json editsJson(const Edits& edits);

/// Reads the section `edits`; an absent one (null, or an empty object) gives no edits. Error:
/// BadInput with the place ("edits.pinned[2].position") for wrong types and values, and for a
/// section of a later version.
Result<Edits> editsFromJson(const nlohmann::json& section);

/// Reads the members named in visitSplitLimits(). A missing one means no limit.
SplitLimits readSplitLimits(const JsonReader& from);

}  // namespace dollytrack
