#include "render/verify/compare/observed_surface.h"

#include "engine/jobs/parallel.h"
#include "render/verify/read/frame_images.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace dollytrack::verify {
namespace {

constexpr int kStep = 4;  // px between samples: much less than a cube of a few centimetres covers

using Cube = std::array<std::int64_t, 3>;

std::map<Cube, Eigen::Vector3d> cubesOf(const StoredDataset& dataset, int index, double spacing_m) {
    std::map<Cube, Eigen::Vector3d> cubes;
    FrameImages images(dataset, index);
    const FrameImages::Depth* depth = images.depth();
    const Image16* ids = images.image16("instance");
    if (!depth) return cubes;
    const StoredFrame& frame = images.stored();
    for (int y = kStep / 2; y < depth->metres.height; y += kStep) {
        for (int x = kStep / 2; x < depth->metres.width; x += kStep) {
            const double metres = depth->metres.at(x, y);
            if (!(metres > 0.0) || (ids && frame.movement(ids->at(x, y)))) continue;
            const Eigen::Vector3d place =
                frame.pose.toWorld(metres * dataset.lens.unproject(x + 0.5, y + 0.5));
            const Eigen::Vector3d cube = (place / spacing_m).array().floor();
            cubes.try_emplace(
                {static_cast<std::int64_t>(cube.x()), static_cast<std::int64_t>(cube.y()),
                 static_cast<std::int64_t>(cube.z())},
                place);
        }
    }
    return cubes;
}

}  // namespace

std::vector<Eigen::Vector3d> observedSurface(const StoredDataset& dataset, double spacing_m) {
    constexpr std::size_t kAtOnce = 32;
    std::map<Cube, Eigen::Vector3d> all;
    for (std::size_t begin = 0; begin < dataset.frames.size(); begin += kAtOnce) {
        std::vector<std::map<Cube, Eigen::Vector3d>> some(
            std::min(kAtOnce, dataset.frames.size() - begin));
        parallelFor(some.size(), [&](std::size_t i) {
            some[i] = cubesOf(dataset, static_cast<int>(begin + i), spacing_m);
        });
        for (auto& cubes : some) all.merge(cubes);  // in frame order
    }
    std::vector<Eigen::Vector3d> points;
    points.reserve(all.size());
    for (const auto& [cube, place] : all) points.push_back(place);
    return points;
}

}  // namespace dollytrack::verify
