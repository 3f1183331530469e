#include "engine/generate/room_furnisher.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

using enum FurnitureRole;

void addSome(Furnisher& f, FurnitureRole role, int count) {
    for (int i = 0; i < count; ++i) addAtWall(f, role);
}

/// Adds the furniture of a kind of room. Groups come first because they need most space.
void furnishKind(RoomKind kind, double area, int objects, Furnisher& f) {
    constexpr double kCluttered = 4.0;  // objects per m2 above which offices get more shelves
    const int shelves = objects > kCluttered * area ? 2 : 0;
    const int more = std::clamp(static_cast<int>(area / 18.0), 1, 4);
    switch (kind) {
        case RoomKind::Suite:
            addBedGroup(f);
            addSofaGroup(f);
            addDiningGroup(f);
            addDeskGroup(f);
            addSome(f, Wardrobe, 2);
            addSome(f, Bookcase, 2);
            addSome(f, Dresser, 1);
            break;
        case RoomKind::Bedroom:
            addBedGroup(f);
            addSome(f, Wardrobe, more);
            if (area > 14.0) addDeskGroup(f);
            addSome(f, Dresser, more);
            addSome(f, Bookcase, 1);
            addSome(f, Armchair, area > 18.0 ? 2 : 0);
            break;
        case RoomKind::Living:
            addSofaGroup(f);
            if (area > 50.0) addSofaGroup(f);
            if (area > 35.0) addDiningGroup(f);
            addSome(f, Bookcase, more + 1);
            addSome(f, Dresser, 1);
            addSome(f, Cabinet, 1);
            break;
        case RoomKind::Dining:
            addDiningGroup(f);
            addSome(f, Dresser, 2);
            addSome(f, Cabinet, 2);
            addSome(f, Bookcase, 2);
            break;
        case RoomKind::Kitchen:
            addKitchen(f);
            if (area > 9.0) addDiningGroup(f);
            break;
        case RoomKind::Office:
            for (int i = 0; i < more + 1; ++i) addDeskGroup(f);
            addSome(f, Bookcase, more + 1 + shelves);
            addSome(f, Cabinet, more + shelves);
            if (area > 30.0) addSofaGroup(f);
            break;
        case RoomKind::Studio:
            addBedGroup(f);
            addDeskGroup(f);
            addSome(f, Bookcase, 1);
            addSome(f, Dresser, 1);
            break;
    }
}

}  // namespace

void furnish(const RoomSpec& spec, Furnisher& furnisher) {
    addDoorAndWindows(furnisher);
    const double area = spec.length_m * spec.width_m;
    furnishKind(spec.kind, area, spec.objects, furnisher);
    const int lamps = area > 35.0 ? 2 : 1;
    for (int i = 0; i < lamps; ++i) {
        addCeilingLamp(furnisher, {furnisher.layout.length() * (i + 1) / (lamps + 1),
                                   0.5 * furnisher.layout.width()});
    }
}

void decorate(RoomKind kind, int objects, int tries, Furnisher& furnisher) {
    const bool kitchen = kind == RoomKind::Kitchen;
    const bool work = kitchen || kind == RoomKind::Dining || kind == RoomKind::Office;
    for (int i = 0; i < tries && furnisher.layout.furnished() < objects; ++i) {
        const std::uint32_t what = furnisher.random.below(8);
        if (what < 3) {
            addWallItem(furnisher);
        } else if (what < 5) {
            addFloorItem(furnisher, FloorPlant);
        } else if (what == 5 && !kitchen) {
            addFloorItem(furnisher, FloorLamp);
        } else {
            addFloorItem(furnisher, work ? WorkFloorItem : FloorItem);
        }
    }
}

}  // namespace dollytrack::generate
