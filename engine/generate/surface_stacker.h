#pragma once

#include "engine/generate/furnisher.h"

namespace dollytrack::generate {

/// Puts small things on and into what stands and hangs in the room, a television on its stand
/// first: on table tops, in shelves, wherever a model's own surface carries the whole thing (see
/// CarrierSurface). Goes on until the room holds `objects`, or for as long as there is hope.
void stackThings(int objects, Furnisher& furnisher);

}  // namespace dollytrack::generate
