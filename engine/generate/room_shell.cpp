#include "engine/generate/room_shell.h"

#include "engine/generate/surface_pictures.h"

#include <array>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;

constexpr const char* kFloorPicture = "floor.png";
constexpr const char* kWallPicture = "wall.png";

homes::HomeSurface pictured(const char* name, double size_cm) {
    homes::HomeSurface surface;
    surface.texture = homes::HomeTexture{name, size_cm, size_cm};
    return surface;
}

void addWalls(const RoomLayout& layout, const homes::HomeSurface& surface, homes::Home& home) {
    const double l = layout.length();
    const double w = layout.width();
    const double h = 0.5 * kWallThickness;
    const std::array<Vector2d, 4> corners = {Vector2d(-h, -h), Vector2d(l + h, -h),
                                             Vector2d(l + h, w + h), Vector2d(-h, w + h)};
    for (int i = 0; i < 4; ++i) {
        homes::HomeWall wall;
        wall.start = corners[i];
        wall.end = corners[(i + 1) % 4];
        wall.thickness = kWallThickness;
        wall.height = layout.height();
        wall.height_at_end = layout.height();
        wall.at_start = (i + 3) % 4;
        wall.at_end = (i + 1) % 4;
        wall.left = surface;
        wall.right = surface;
        home.walls.push_back(wall);
    }
}

}  // namespace

Status addShell(const RoomLayout& layout, RoomKind kind, Random& random, homes::Home& home,
                std::vector<ArchiveFile>& files) {
    const bool tiled = kind == RoomKind::Kitchen;
    auto floor = tiled ? tilesPicture(random) : boardsPicture(random);
    if (!floor) return tl::unexpected(floor.error());
    auto wall = plasterPicture(random);
    if (!wall) return tl::unexpected(wall.error());
    files.push_back({kFloorPicture, std::move(*floor)});
    files.push_back({kWallPicture, std::move(*wall)});

    addWalls(layout, pictured(kWallPicture, kPlasterSize), home);
    homes::HomeRoom room;
    room.name = std::string(roomKindName(kind));
    room.points = {{0.0, 0.0},
                   {layout.length(), 0.0},
                   {layout.length(), layout.width()},
                   {0.0, layout.width()}};
    room.floor = pictured(kFloorPicture, tiled ? kTilesSize : kBoardsSize);
    room.ceiling.color = Eigen::Vector3f(0.85F, 0.85F, 0.83F);
    home.rooms.push_back(std::move(room));
    home.wall_height = layout.height();
    return {};
}

}  // namespace dollytrack::generate
