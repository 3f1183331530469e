#pragma once

#include "engine/generate/furnisher.h"
#include "engine/generate/room_spec.h"

namespace dollytrack::generate {

/// Adds door, windows, ceiling lamps and the furniture of the room's kind, grouped by function:
/// beds with night stands, seats around tables, a sofa facing its television, kitchen units.
void furnish(const RoomSpec& spec, Furnisher& furnisher);

/// Adds decorations on walls and floor until the room contains `objects` objects, with at most
/// `tries` attempts.
void decorate(RoomKind kind, int objects, int tries, Furnisher& furnisher);

}  // namespace dollytrack::generate
