#pragma once

#include <nlohmann/json_fwd.hpp>

namespace dollytrack {

/// Copies into the entries of `section`, a section `edits`, what the same entries of an earlier one
/// have and this version does not know: notes of people, keys of later versions. Entries are the
/// same by what they are about: their name, or the objects they name. What has no entry any more is
/// gone with its keys.
void keepUnknownKeys(const nlohmann::json& earlier, nlohmann::json& section);

}  // namespace dollytrack
