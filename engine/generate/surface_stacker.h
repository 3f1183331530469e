#pragma once

#include "engine/generate/furnisher.h"

namespace dollytrack::generate {

/// Places small objects on and in the furniture, televisions on their stands first; see
/// CarrierSurface for the possible positions. Stops when the room contains `objects` objects or
/// after a limited number of attempts.
void stackThings(int objects, Furnisher& furnisher);

}  // namespace dollytrack::generate
