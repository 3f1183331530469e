#pragma once

#include "engine/generate/furnisher.h"

namespace dollytrack::generate {

/// Places small objects on and in the furniture, televisions on their stands first; see
/// SupportSurface for the possible positions. Stops when the room contains `objects` objects or
/// after a limited number of attempts.
void stackItems(int objects, Furnisher& furnisher);

}  // namespace dollytrack::generate
