#include "engine/io/pointcloud/cloud_objects.h"

#include "engine/io/pointcloud/point_grid.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace dollytrack {
namespace {

constexpr double kLevel = 0.94;      // cosine of 20 degrees
constexpr double kUpright = 0.26;    // sine of 15 degrees
constexpr double kBehind = 0.15;     // m: points within this distance of a plane are not behind it
constexpr double kMostBehind = 0.1;  // largest share of the cloud behind a wall
constexpr double kTopArea = 0.08;    // m2; smallest flat top on which objects stand

struct Heights {
    double low = 0.0;
    double high = 0.0;
};

Heights spanOf(const CloudSamples& samples, const Eigen::Vector3d& up) {
    std::vector<double> heights;
    for (const Eigen::Vector3d& p : samples.points) heights.push_back(up.dot(p));
    std::sort(heights.begin(), heights.end());
    const std::size_t cut = heights.size() / 100;
    return {heights[cut], heights[heights.size() - 1 - cut]};
}

/// NYU40 class of a plane: floor, ceiling or wall; 0 for all others.
int classOf(const CloudPlane& plane, const CloudSamples& samples, const Eigen::Vector3d& up,
            const Heights& room) {
    double low = 1e300;
    double high = -1e300;
    for (const std::uint32_t i : plane.points) {
        low = std::min(low, up.dot(samples.points[i]));
        high = std::max(high, up.dot(samples.points[i]));
    }
    const double facing = plane.normal.dot(up);
    const double tall = room.high - room.low;
    const double slack = std::max(0.12, 0.1 * tall);
    if (facing > kLevel) return low < room.low + slack ? int{kNyuFloor} : 0;
    if (facing < -kLevel) return high > room.high - slack ? int{kNyuCeiling} : 0;
    if (std::abs(facing) > kUpright) return 0;
    const bool reaches = high - low > std::min(1.6, 0.6 * tall);
    std::size_t behind = 0;
    for (const Eigen::Vector3d& p : samples.points) behind += plane.height(p) < -kBehind ? 1U : 0U;
    const bool outside =
        static_cast<double>(behind) < kMostBehind * static_cast<double>(samples.points.size());
    return reaches && outside && plane.area_m2 > 0.5 ? int{kNyuWall} : 0;
}

/// Connected components of some samples; points within `reach` of each other are connected.
std::vector<std::vector<std::uint32_t>> piecesOf(const CloudSamples& samples,
                                                 const std::vector<std::uint32_t>& some,
                                                 double reach) {
    std::vector<Eigen::Vector3d> places;
    for (const std::uint32_t i : some) places.push_back(samples.points[i]);
    const PointGrid grid(places, reach);
    std::vector<int> piece(places.size(), -1);
    std::vector<std::vector<std::uint32_t>> pieces;
    std::vector<std::uint32_t> open;
    for (std::uint32_t first = 0; first < places.size(); ++first) {
        if (piece[first] >= 0) continue;
        const int number = static_cast<int>(pieces.size());
        pieces.emplace_back();
        piece[first] = number;
        open.push_back(first);
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            open.pop_back();
            pieces.back().push_back(some[at]);
            grid.forNear(places[at], reach, [&](std::uint32_t next, double) {
                if (piece[next] >= 0) return;
                piece[next] = number;
                open.push_back(next);
            });
        }
        std::sort(pieces.back().begin(), pieces.back().end());
    }
    return pieces;
}

double diagonalOf(const CloudSamples& samples, const std::vector<std::uint32_t>& some) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t i : some) box.extend(samples.points[i]);
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

/// The height of the largest flat top of a piece; -1e300 if there is none.
double topOf(const CloudSamples& samples, const std::vector<std::uint32_t>& piece,
             const Eigen::Vector3d& up, double step) {
    std::map<long, std::size_t> levels;
    for (const std::uint32_t i : piece) {
        if (samples.normals[i].dot(up) < kLevel) continue;
        ++levels[std::lround(up.dot(samples.points[i]) / step)];
    }
    double best = -1e300;
    double most = kTopArea;
    for (const auto& [level, count] : levels) {
        const auto next = levels.find(level + 1);
        const std::size_t both = count + (next == levels.end() ? 0 : next->second);
        const double area = static_cast<double>(both) * samples.voxel_m * samples.voxel_m;
        if (area < most) continue;
        most = area;
        best = (static_cast<double>(level) + 0.5) * step;
    }
    return best;
}

class Labeller {
  public:
    Labeller(const CloudSamples& samples, const Eigen::Vector3d& up, const CloudParams& params)
        : samples_(samples),
          up_(up),
          params_(params),
          reach_(std::max(2.5 * samples.voxel_m, 0.04)) {
        labels_.object_of.assign(samples.points.size(), -1);
    }

    void addStructure(const std::vector<CloudPlane>& planes) {
        const Heights room = spanOf(samples_, up_);
        std::map<int, int> thing_of_class;
        for (const CloudPlane& plane : planes) {
            const int nyu40 = classOf(plane, samples_, up_, room);
            if (nyu40 == 0) continue;
            auto [found, is_new] = thing_of_class.try_emplace(nyu40, -1);
            // Each wall is an object of its own; all floor planes form one, as do ceilings.
            if (is_new || nyu40 == kNyuWall) {
                found->second = static_cast<int>(labels_.objects.size());
                std::string name(nyu40Name(nyu40));
                if (nyu40 == kNyuWall) name = fmt::format("{}_{}", name, ++walls_);
                labels_.objects.push_back({std::move(name), nyu40, true});
            }
            // Noise and flat objects on a plane belong to it as well.
            for (std::size_t i = 0; i < samples_.points.size(); ++i) {
                const bool on =
                    std::abs(plane.height(samples_.points[i])) < 1.5 * params_.plane_m &&
                    plane.normal.dot(samples_.normals[i]) > 0.5;
                if (on && labels_.object_of[i] < 0) {
                    labels_.object_of[i] = found->second;
                }
            }
        }
    }

    void addObjects() {
        std::vector<std::uint32_t> rest;
        for (std::uint32_t i = 0; i < labels_.object_of.size(); ++i) {
            if (labels_.object_of[i] < 0) rest.push_back(i);
        }
        for (const auto& piece : piecesOf(samples_, rest, reach_)) addPiece(piece);
        for (const int object : labels_.object_of) labels_.specks += object < 0 ? 1U : 0U;
    }

    [[nodiscard]] CloudLabels take() { return std::move(labels_); }

  private:
    void addPiece(const std::vector<std::uint32_t>& piece) {
        if (!isObject(piece)) return;
        const double step = params_.plane_m;
        const double top = topOf(samples_, piece, up_, step) + 1.5 * step;
        std::vector<std::uint32_t> above;
        std::vector<std::uint32_t> below;
        for (const std::uint32_t i : piece) {
            (top > -1e200 && up_.dot(samples_.points[i]) > top ? above : below).push_back(i);
        }
        std::vector<std::vector<std::uint32_t>> standing;
        for (auto& on_top : piecesOf(samples_, above, reach_)) {
            if (isObject(on_top)) {
                standing.push_back(std::move(on_top));
            } else {
                below.insert(below.end(), on_top.begin(), on_top.end());
            }
        }
        if (!below.empty()) add(below);
        for (const auto& one : standing) add(one);
    }

    [[nodiscard]] bool isObject(const std::vector<std::uint32_t>& piece) const {
        return piece.size() >= 12 && diagonalOf(samples_, piece) >= params_.object_m;
    }

    void add(const std::vector<std::uint32_t>& piece) {
        const int object = static_cast<int>(labels_.objects.size());
        labels_.objects.push_back({fmt::format("furniture_{}", ++furniture_count_), 0, false});
        for (const std::uint32_t i : piece) labels_.object_of[i] = object;
    }

    const CloudSamples& samples_;
    Eigen::Vector3d up_;
    CloudParams params_;
    double reach_;  // m; largest distance between connected points
    int walls_ = 0;
    int furniture_count_ = 0;
    CloudLabels labels_;
};

}  // namespace

CloudLabels labelCloud(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
                       const Eigen::Vector3d& up, const CloudParams& params) {
    Labeller labeller(samples, up, params);
    labeller.addStructure(planes);
    labeller.addObjects();
    return labeller.take();
}

}  // namespace dollytrack
