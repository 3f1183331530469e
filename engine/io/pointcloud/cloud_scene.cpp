#include "engine/io/pointcloud/cloud_scene.h"

#include "engine/geometry/cloud_error.h"
#include "engine/io/pointcloud/cloud_depths.h"
#include "engine/io/pointcloud/cloud_floor.h"
#include "engine/io/pointcloud/cloud_frame.h"
#include "engine/io/pointcloud/cloud_objects.h"
#include "engine/io/pointcloud/cloud_surface.h"
#include "engine/io/pointcloud/cloud_texture.h"
#include "engine/io/pointcloud/files/cloud_file.h"
#include "engine/io/raw_scene/mesh_part_builder.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace dollytrack {
namespace {

constexpr double kFarAway = 5'000.0;          // file units from the origin; floats are coarse there
constexpr double kMuchScatter = 0.015;        // m; from here on a warning instead of a note
constexpr std::size_t kFewestPoints = 50;     // smallest number of samples of a surface
constexpr std::size_t kMostJudged = 100'000;  // points whose distance to the surface is measured

tl::unexpected<Error> cancelled(const std::filesystem::path& path) {
    return fail(ErrorCode::Cancelled, "import was cancelled", path.string());
}

tl::unexpected<Error> noSurface(std::size_t points, const std::filesystem::path& path) {
    return fail(ErrorCode::BadInput,
                fmt::format("The {} points form no surface because they are too few or too far "
                            "apart; raise the cloud's voxel_m and gap_m.",
                            points),
                path.string());
}

/// The box from the 1st to the 99th percentile of the coordinates on each axis.
Eigen::AlignedBox3d coreOf(const PointCloud& cloud) {
    Eigen::AlignedBox3d core;
    core.min().setZero();
    core.max().setZero();
    std::vector<double> values(cloud.points.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = cloud.points[i][axis];
        const auto at = [&](std::size_t i) {
            std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i),
                             values.end());
            return values[i];
        };
        core.min()[axis] = at(values.size() / 100);
        core.max()[axis] = at(values.size() - 1 - values.size() / 100);
    }
    return core;
}

/// Metres per unit: 1, as scanners write, or if that is too large for a building 0.01 or 0.001.
double judgeUnit(const Eigen::AlignedBox3d& core) {
    const double longest = core.sizes().maxCoeff();
    if (longest > 2'500.0) return 0.001;
    return longest > 120.0 ? 0.01 : 1.0;
}

/// Converts the cloud to metres and moves it near the origin; drops and counts distant points.
Eigen::Vector3d toMetres(PointCloud& cloud, const Eigen::AlignedBox3d& core, double unit_m,
                         std::size_t& strays) {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    if (core.center().norm() > kFarAway) origin = core.center().array().round();
    const double reach = std::max(1e-9, 4.0 * core.sizes().maxCoeff());
    PointCloud kept;
    kept.left_out = cloud.left_out;
    kept.splats = cloud.splats;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        if ((cloud.points[i] - core.center()).cwiseAbs().maxCoeff() > reach) {
            ++strays;
            continue;
        }
        kept.points.push_back(unit_m * (cloud.points[i] - origin));
        if (!cloud.colors.empty()) kept.colors.push_back(cloud.colors[i]);
        if (!cloud.normals.empty()) kept.normals.push_back(cloud.normals[i]);
    }
    if (cloud.viewpoint) kept.viewpoint = unit_m * (*cloud.viewpoint - origin);
    cloud = std::move(kept);
    return origin;
}

/// The rotation of `up` to the axis: first by multiples of 90 degrees, so that the coordinates of a
/// level cloud are only permuted.
Eigen::Matrix3d levelling(const Eigen::Vector3d& up, UpAxis axis) {
    const Eigen::Vector3d goal = axis.direction();
    Eigen::Index nearest = 0;
    up.cwiseAbs().maxCoeff(&nearest);
    const Eigen::Vector3d rough = up[nearest] < 0.0
                                      ? Eigen::Vector3d(-Eigen::Vector3d::Unit(nearest))
                                      : Eigen::Vector3d(Eigen::Vector3d::Unit(nearest));
    Eigen::Matrix3d quarter = Eigen::Matrix3d::Identity();
    if (rough.isApprox(-goal)) {
        quarter = -quarter;
        quarter((axis.index() + 1) % 3, (axis.index() + 1) % 3) = 1.0;
    } else if (!rough.isApprox(goal)) {
        quarter = Eigen::Quaterniond::FromTwoVectors(rough, goal).toRotationMatrix();
        quarter = quarter.array().round();
    }
    return Eigen::Quaterniond::FromTwoVectors(quarter * up, goal).toRotationMatrix() * quarter;
}

void turn(const Eigen::Matrix3d& rotation, PointCloud& cloud, CloudSamples& samples) {
    for (Eigen::Vector3d& p : cloud.points) p = rotation * p;
    if (cloud.viewpoint) cloud.viewpoint = rotation * *cloud.viewpoint;
    for (Eigen::Vector3d& p : samples.points) p = rotation * p;
    for (Eigen::Vector3d& n : samples.normals) n = rotation * n;
}

/// Removes samples without an object, from both lists.
void dropSpecks(CloudSamples& samples, CloudLabels& labels) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        if (labels.object_of[i] < 0) continue;
        samples.points[kept] = samples.points[i];
        samples.normals[kept] = samples.normals[i];
        labels.object_of[kept++] = labels.object_of[i];
    }
    samples.points.resize(kept);
    samples.normals.resize(kept);
    labels.object_of.resize(kept);
}

/// The object of a triangle: that of two of its corners, otherwise its first corner's.
int objectOf(const CloudLabels& labels, const Triangle& t) {
    const int a = labels.object_of[t[0]];
    const int b = labels.object_of[t[1]];
    const int c = labels.object_of[t[2]];
    return b == c ? b : a;
}

CloudError measure(const std::vector<Eigen::Vector3d>& points, const CloudSamples& samples,
                   const std::vector<Triangle>& triangles) {
    Scene scene;
    for (const Eigen::Vector3d& p : samples.points) scene.positions.push_back(p.cast<float>());
    scene.triangles = triangles;
    scene.objects.resize(1);
    scene.objects[0].id = 1;
    scene.objects[0].vertex_count = static_cast<std::uint32_t>(scene.positions.size());
    scene.objects[0].triangle_count = static_cast<std::uint32_t>(triangles.size());
    std::vector<Eigen::Vector3d> judged;
    const std::size_t step = points.size() / kMostJudged + 1;
    for (std::size_t i = 0; i < points.size(); i += step) judged.push_back(points[i]);
    return cloudError(judged, RayCaster(scene));
}

Material plainMaterial(const CloudObject& object) {
    Material material;
    material.name = object.name;
    return material;
}

/// Builds one part per object and texture, in the order of the triangles.
void buildParts(const CloudSamples& samples, const CloudLabels& labels,
                const std::vector<Triangle>& sorted, const PointCloud& cloud, RawScene& raw) {
    const bool coloured = !cloud.colors.empty();
    const CloudTexture texture(coloured ? sorted.size() : 0);
    std::vector<Eigen::Vector3d> corners;
    for (const Triangle& t : sorted) {
        for (const std::uint32_t v : t) corners.push_back(samples.points[v]);
    }
    if (coloured) raw.textures = texture.paint(corners, cloud, samples.voxel_m);
    for (std::size_t i = 0; i < raw.textures.size(); ++i) {
        Material material;
        material.name = "scan";
        material.base_color = {1.0F, 1.0F, 1.0F};
        material.texture = static_cast<int>(i);
        raw.materials.push_back(material);
    }
    raw.nodes.push_back({"", -1, 0});
    for (std::size_t first = 0; first < sorted.size();) {
        const std::size_t object = objectOf(labels, sorted[first]);
        const auto pictureOf = [&](std::size_t t) { return coloured ? texture.pictureOf(t) : 0; };
        std::vector<Eigen::Vector3f> positions;
        std::vector<Eigen::Vector3f> normals;
        std::vector<Eigen::Vector3f> uvs;
        std::vector<std::uint32_t> indices;
        std::size_t end = first;
        for (; end < sorted.size() && pictureOf(end) == pictureOf(first) &&
               static_cast<std::size_t>(objectOf(labels, sorted[end])) == object;
             ++end) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t v = sorted[end][corner];
                indices.push_back(static_cast<std::uint32_t>(positions.size()));
                positions.push_back(samples.points[v].cast<float>());
                normals.push_back(samples.normals[v].cast<float>());
                const Eigen::Vector2f uv =
                    coloured ? texture.uv(end, corner) : Eigen::Vector2f(0.0F, 0.0F);
                uvs.emplace_back(uv.x(), uv.y(), 0.0F);
            }
        }
        if (raw.objects[object].parts.empty()) {
            raw.nodes.push_back({labels.objects[object].name, 0, 0});
            ++raw.nodes.front().children;
        }
        MeshPart part;
        part.name = labels.objects[object].name;
        part.node = static_cast<int>(raw.nodes.size()) - 1;
        part.material =
            static_cast<std::uint32_t>(coloured ? pictureOf(first) : raw.materials.size());
        if (!coloured) raw.materials.push_back(plainMaterial(labels.objects[object]));
        const std::vector<std::uint32_t> sizes(end - first, 3);
        raw.repairs.add(buildMeshPart({positions, normals, uvs, sizes, indices},
                                      Eigen::Affine3d::Identity(), part));
        raw.objects[object].parts.push_back(raw.parts.size());
        raw.parts.push_back(std::move(part));
        first = end;
    }
    if (raw.materials.empty()) raw.materials.emplace_back();
}

}  // namespace

Result<RawScene> readPointCloud(const std::filesystem::path& path, const ImportOptions& options,
                                const JobContext& job) {
    Result<PointCloud> read = readCloudFile(path);
    if (!read) return tl::unexpected(std::move(read.error()));
    PointCloud& cloud = *read;
    const std::size_t points = cloud.points.size();
    if (job.cancelled()) return cancelled(path);
    job.report(0.1);
    RawScene raw;
    const Eigen::AlignedBox3d core = coreOf(cloud);
    const double unit_m = options.unit_m.value_or(judgeUnit(core));
    std::size_t strays = 0;
    const Eigen::Vector3d origin = toMetres(cloud, core, unit_m, strays);

    std::vector<Eigen::Vector3d> scanned = cloud.points;  // to measure the surface's error
    const double step = smoothDepths(cloud, job);
    if (!cloud.viewpoint && step > 0.0) cloud.viewpoint = -unit_m * origin;
    CloudSamples samples = sampleCloud(cloud, options.cloud, job.stage(0.1, 0.3, "normals"));
    const std::vector<CloudPlane> planes =
        findPlanes(samples, options.cloud.plane_m, job.stage(0.3, 0.4, "walls and floors"));
    if (job.cancelled()) return cancelled(path);
    if (samples.points.size() < kFewestPoints) return noSurface(points, path);
    const CloudUp up = findUp(samples, planes, -unit_m * origin, options.up_axis);
    CloudLabels labels = labelCloud(samples, planes, up.up, options.cloud);
    const UpAxis axis = options.up_axis.value_or('z');
    const Eigen::Matrix3d parts_from_file = levelling(up.up, axis);
    turn(parts_from_file, cloud, samples);
    for (Eigen::Vector3d& p : scanned) p = parts_from_file * p;
    dropSpecks(samples, labels);
    Result<CloudSurface> surface =
        meshCloud(samples, options.cloud, job.stage(0.45, 0.85, "surface"));
    if (!surface) return tl::unexpected(std::move(surface.error()));
    if (surface->triangles.empty()) return noSurface(points, path);
    const CloudError error = measure(scanned, samples, surface->triangles);
    if (job.cancelled()) return cancelled(path);
    job.report(0.9);

    std::stable_sort(surface->triangles.begin(), surface->triangles.end(),
                     [&](const Triangle& a, const Triangle& b) {
                         return objectOf(labels, a) < objectOf(labels, b);
                     });
    for (const CloudObject& object : labels.objects) {
        SourceObject& source = raw.objects.emplace_back();
        source.name = object.name;
        source.nyu40 = object.nyu40;
        source.structure = object.structure;
    }
    buildParts(samples, labels, surface->triangles, cloud, raw);
    addFloor(samples, labels, cloud.viewpoint, axis, raw);
    // Convert from metres to file units, as the caller expects.
    raw.file_up_axis = axis;
    raw.file_unit_m = unit_m;
    raw.file_from_parts.linear() = parts_from_file.transpose();
    raw.file_from_parts.translation() = origin;
    for (MeshPart& part : raw.parts) {
        for (Eigen::Vector3f& p : part.positions) p /= static_cast<float>(unit_m);
        part.bounds.min() /= static_cast<float>(unit_m);
        part.bounds.max() /= static_cast<float>(unit_m);
        part.area /= unit_m * unit_m;
        for (double& area : part.facing_area) area /= unit_m * unit_m;
    }
    if (cloud.left_out + strays + labels.specks > 0) {
        raw.notes.push_back(fmt::format(
            "{} points without a position, {} far away and {} in small clusters were left out",
            cloud.left_out, strays, labels.specks));
    }
    raw.notes.push_back(
        fmt::format("{} points were reduced to {} samples {:.0f} mm apart and meshed as {} "
                    "triangles; {} holes were filled with {} triangles",
                    points, samples.points.size(), samples.voxel_m * 1e3, surface->triangles.size(),
                    surface->holes_filled, surface->hole_triangles));
    raw.notes.push_back(fmt::format(
        "distance of the points from the surface: {:.1f} mm (median), {:.1f} mm (95th percentile)",
        error.median_m * 1e3, error.p95_m * 1e3));
    if (step > 0.0) {
        raw.notes.push_back(fmt::format(
            "depths are quantized ({:.0f} mm at 4 m); points were smoothed along their rays",
            16.0e3 * step));
    }
    if (cloud.splats) {
        raw.warnings.push_back(
            "the file contains Gaussian splats, whose centres were read as points with scatter "
            "around the surfaces; a mesh of the scene is more exact");
    }
    if (samples.spacing_m > 0.0) {
        raw.warnings.push_back(
            fmt::format("the points are {:.0f} mm apart, and details smaller than a few times this "
                        "distance are lost; scan from closer, or check the objects",
                        samples.spacing_m * 1e3));
    }
    if (samples.smoothed_m > 0.0) {
        auto& told = samples.scatter_m > kMuchScatter ? raw.warnings : raw.notes;
        told.push_back(
            fmt::format("the points have {:.0f} mm of noise; they were moved onto planes fitted to "
                        "neighbours within {:.0f} mm, which rounds edges",
                        samples.scatter_m * 1e3, samples.smoothed_m * 1e3));
    }
    raw.notes.push_back(
        "a level floor, \"floor_unseen\", was added below the scan to close gaps behind furniture "
        "and below the scanner");
    if (!options.unit_m) {
        raw.notes.push_back(
            fmt::format("1 unit of the cloud is {} m, estimated by its size", unit_m));
    }
    raw.notes.push_back("up in the cloud: " + up.source + "; --up sets it");
    if (up.doubtful) {
        raw.warnings.push_back(
            "the cloud's upward axis is doubtful; pass --up if the room is upside down or on its "
            "side");
    }
    return raw;
}

}  // namespace dollytrack
