#pragma once

#include <nlohmann/json_fwd.hpp>

namespace dollytrack {

/// Copies keys that this version does not know (notes of people, keys of later versions) from the
/// entries of `earlier` to the same entries of `section`, both being sections `edits`. Entries are
/// the same if they have the same name or refer to the same objects. Keys of entries that no longer
/// exist are dropped.
void keepUnknownKeys(const nlohmann::json& earlier, nlohmann::json& section);

}  // namespace dollytrack
