#include "ui/overlays/grid_overlay.h"

#include "ui/overlays/palette.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::ui {
namespace {

// Between the background colours of both themes, to stand out from either.
const Eigen::Vector4f kGrid(0.47F, 0.52F, 0.60F, 1.0F);
constexpr double kBeside_m = 2.0;
constexpr double kMost = 200.0;  // squares in a row; more would merge into a grey area

}  // namespace

PlanLayer gridLayer(const Eigen::AlignedBox3d& room, double floor_z) {
    PlanLayer layer;
    if (room.isEmpty()) return layer;
    const Eigen::Vector2d beside = Eigen::Vector2d::Constant(kBeside_m);
    const Eigen::Vector2d low = room.min().head<2>() - beside;
    const Eigen::Vector2d high = room.max().head<2>() + beside;
    double square = 1.0;
    while ((high - low).maxCoeff() / square > kMost) square *= 10.0;
    // Extends the grid to whole squares.
    const Eigen::Vector2d first = (low / square).array().floor();
    const Eigen::Vector2d last = (high / square).array().ceil();
    for (const int axis : {0, 1}) {
        const int other = 1 - axis;
        for (double i = first[axis]; i <= last[axis]; i += 1.0) {
            Eigen::Vector3d a(0, 0, floor_z);
            a[axis] = i * square;
            a[other] = first[other] * square;
            Eigen::Vector3d b = a;
            b[other] = last[other] * square;
            const bool bold = std::fmod(i, 5.0) == 0.0;
            layer.overlay.lines.push_back(
                {a, b, withOpacity(kGrid, bold ? 0.95F : 0.7F), bold ? 2.0 : 1.2});
        }
    }
    layer.legend.title = "Grid";
    const Eigen::Vector2d count = last - first;
    layer.legend.entries.push_back({fmt::format("squares of {:g} m", square),
                                    LegendEntry::Shape::Line, kGrid,
                                    static_cast<int>(count.x() * count.y())});
    return layer;
}

}  // namespace dollytrack::ui
