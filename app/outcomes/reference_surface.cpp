#include "app/outcomes/outcome_run.h"

#include "engine/io/files/durable_file.h"
#include "planning/baselines/reachable_surface.h"

#include <fmt/format.h>

#include <cstring>

namespace dollytrack::outcomes {
namespace {

constexpr double kReferenceSpacing_m = 0.04;

/// The samples in NumPy's NPY format 1.0: a text header, then little-endian rows, the byte order of
/// the supported platforms.
std::string npyOf(const std::vector<planning::SurfacePatch>& samples) {
    constexpr std::size_t kAlignment = 64;
    constexpr std::size_t kMagicBytes = 10;
    std::string header = fmt::format(
        "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, 6), }}", samples.size());
    header.append(kAlignment - (kMagicBytes + header.size() + 1) % kAlignment, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 0xffU);
    bytes += static_cast<char>(header.size() >> 8U);
    bytes += header;
    for (const planning::SurfacePatch& sample : samples) {
        for (const Eigen::Vector3d& vector : {sample.point, sample.normal}) {
            const Eigen::Vector3f numbers = vector.cast<float>();
            bytes.append(reinterpret_cast<const char*>(numbers.data()), 3 * sizeof(float));
        }
    }
    return bytes;
}

}  // namespace

Status writeReferenceSurface(const cli::SceneArguments& scene, const std::filesystem::path& file,
                             const JobContext& job) {
    const Result<cli::OpenedScene> opened = cli::openScene(scene, job.stage(0.0, 0.2, "loading"));
    if (!opened) return tl::unexpected(opened.error());
    const auto map = planning::mapScene(opened->scene, opened->plan_edits, opened->params,
                                        job.stage(0.2, 0.5, "free space"));
    if (!map) return tl::unexpected(map.error());
    const auto samples = planning::reachableSurface(*map, kReferenceSpacing_m,
                                                    job.stage(0.5, 1.0, "reference surface"));
    if (!samples) return tl::unexpected(samples.error());
    return writeWhole(file, npyOf(*samples));
}

}  // namespace dollytrack::outcomes
