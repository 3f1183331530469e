#pragma once

#include "engine/io/files/guarded_folder.h"

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace dollytrack {

/// Removes files of a folder whose names end so, those written longest ago first, until at most
/// `most_bytes` of them remain; and what programs that were ended left half written.
void evictOldest(const GuardedFolder& folder, std::initializer_list<std::string_view> endings,
                 std::uint64_t most_bytes);

}  // namespace dollytrack
