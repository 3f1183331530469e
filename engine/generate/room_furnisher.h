#pragma once

#include "engine/generate/furnisher.h"
#include "engine/generate/room_spec.h"

namespace dollytrack::generate {

/// Door, windows and the furniture of a room's kind, by function: beds with night stands, seats
/// around tables, a sofa that faces its television, runs of kitchen units.
void furnish(const RoomSpec& spec, Furnisher& furnisher);

/// Things on walls and on the floor, until the room holds `objects` or `tries` were made.
void decorate(RoomKind kind, int objects, int tries, Furnisher& furnisher);

}  // namespace dollytrack::generate
