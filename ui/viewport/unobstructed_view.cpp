#include "ui/viewport/unobstructed_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dollytrack::ui {
namespace {

constexpr double kMost = 0.8;         // visible fraction at which the search stops
constexpr double kTouching_m = 2e-3;  // the object's own surface may lie on its box
constexpr int kThroughAtMost = 16;    // limit of omitted surfaces along one ray

/// Where a ray enters a box, as a fraction of `way`; 0 if it starts inside.
double entryInto(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                 const Eigen::Vector3d& way) {
    double entry = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) continue;
        const double border = way[axis] > 0.0 ? box.min()[axis] : box.max()[axis];
        entry = std::max(entry, (border - from[axis]) / way[axis]);
    }
    return entry;
}

bool reaches(const RayCaster& rays, const Eigen::Vector3d& eye, const Eigen::Vector3d& way,
             double end, const IsCutAway& left_away) {
    double begin = 0.0;
    for (int i = 0; i < kThroughAtMost; ++i) {
        const RayHit hit = rays.cast(eye, way, end, begin);
        if (hit.object_id == 0) return true;
        if (!left_away(hit.object_id, eye + hit.distance * way)) return false;
        begin = hit.distance + 1e-6;
    }
    return false;
}

struct Turn {
    double aside = 0.0;  // rad
    double up = 0.0;
    [[nodiscard]] double size() const { return std::abs(aside) + 1.5 * std::abs(up); }
};

std::vector<Turn> turnsBySize() {
    constexpr std::array kAside = {0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 2.8};
    std::vector<Turn> turns;
    for (const double up : {0.0, 0.3, -0.3, 0.6, -0.6}) {
        for (const double aside : kAside) {
            turns.push_back({aside, up});
            if (aside > 0.0) turns.push_back({-aside, up});
        }
    }
    std::ranges::stable_sort(turns, {}, &Turn::size);
    return turns;
}

}  // namespace

double shareSeen(const RayCaster& rays, const Eigen::Vector3d& eye, const Eigen::AlignedBox3d& box,
                 const IsCutAway& left_away) {
    const Eigen::AlignedBox3d around(box.min().array() - kTouching_m,
                                     box.max().array() + kTouching_m);
    int reached = 0;
    for (int i = 0; i < 27; ++i) {
        const Eigen::Array3d place(0.1 + 0.4 * (i % 3), 0.1 + 0.4 * (i / 3 % 3),
                                   0.1 + 0.4 * (i / 9));
        const Eigen::Vector3d way = box.min() + (place * box.sizes().array()).matrix() - eye;
        if (reaches(rays, eye, way, entryInto(around, eye, way), left_away)) ++reached;
    }
    return reached / 27.0;
}

ViewerCamera unobstructedView(const ViewerCamera& framed,
                              const std::function<double(const ViewerCamera& camera)>& share_seen) {
    ViewerCamera best = framed;
    double most = -1.0;
    for (const Turn& turn : turnsBySize()) {
        ViewerCamera tried = framed;
        tried.azimuth += turn.aside;
        tried.elevation = std::clamp(tried.elevation + turn.up, 0.05, 1.5);
        const double share = share_seen(tried);
        if (share <= most + 1e-9) continue;
        most = share;
        best = tried;
        if (most >= kMost) break;
    }
    return best;
}

}  // namespace dollytrack::ui
