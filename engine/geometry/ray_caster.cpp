#include "engine/geometry/ray_caster.h"

#include "engine/geometry/closest_on_triangle.h"
#include "engine/jobs/parallel.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

namespace dollytrack {
namespace {

constexpr std::size_t kManyTriangles = 4'000'000;

float upperBound(double max_distance) {
    return static_cast<float>(
        std::min(max_distance, static_cast<double>(std::numeric_limits<float>::infinity())));
}

/// A ray that hits nothing if its origin or direction is not finite or too large: Embree aborts the
/// process on such numbers.
RTCRay makeRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double min_distance,
               double max_distance) {
    constexpr double kLargest = 1e18;
    RTCRay ray{};
    ray.mask = ~0U;
    const double size =
        origin.cwiseAbs().sum() + direction.cwiseAbs().sum() + std::abs(min_distance);
    if (!(size < kLargest)) {  // also if it is not a number
        ray.tnear = 1.0F;
        return ray;
    }
    ray.org_x = static_cast<float>(origin.x());
    ray.org_y = static_cast<float>(origin.y());
    ray.org_z = static_cast<float>(origin.z());
    ray.dir_x = static_cast<float>(direction.x());
    ray.dir_y = static_cast<float>(direction.y());
    ray.dir_z = static_cast<float>(direction.z());
    ray.tnear = static_cast<float>(min_distance);
    ray.tfar = upperBound(max_distance);
    return ray;
}

struct ObjectGeometry {
    RTCGeometry geometry = nullptr;
    const float* vertices = nullptr;  // Embree's copy
    const unsigned* indices = nullptr;
    std::uint32_t first_triangle = 0;
    RTCScene alone = nullptr;  // a separate scene, for queries of this object only

    [[nodiscard]] Eigen::Vector3d corner(unsigned triangle, unsigned k) const {
        const float* v = vertices + 3UL * indices[3UL * triangle + k];
        return {v[0], v[1], v[2]};
    }
};

struct ClosestSearch {
    const std::vector<ObjectGeometry>* objects = nullptr;
    Eigen::Vector3d query;
    double best_squared = 0.0;
    ClosestPoint best;
    bool any = false;       // stop at the first surface found
    float rounding = 0.0F;  // error of the query point's floats, m
};

bool visitClosest(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<ClosestSearch*>(arguments->userPtr);
    const ObjectGeometry& object = (*search.objects)[arguments->geomID];
    const unsigned triangle = arguments->primID;
    const Eigen::Vector3d point =
        closestOnTriangle(search.query, object.corner(triangle, 0), object.corner(triangle, 1),
                          object.corner(triangle, 2));
    const double squared = (point - search.query).squaredNorm();
    const int id = static_cast<int>(arguments->geomID) + 1;
    // Of objects at equal distance, the lowest number is taken, because the order of visits depends
    // on the other objects in the scene.
    const bool as_near = squared == search.best_squared && id < search.best.object_id;
    if (squared >= search.best_squared && !as_near) return false;
    search.best_squared = squared;
    search.best = {id, std::sqrt(squared), point};
    // Rounded up, so that float rounding never excludes a triangle at the same or a smaller
    // distance.
    arguments->query->radius =
        search.any ? 0.0F : static_cast<float>(search.best.distance) * 1.000001F + search.rounding;
    return true;
}

/// The closest surface within `max_distance`, or with `any` the first one found within it.
ClosestPoint findSurface(RTCScene scene, const std::vector<ObjectGeometry>& objects,
                         const Eigen::Vector3d& point, double max_distance, bool any) {
    ClosestSearch search;
    search.objects = &objects;
    search.query = point;
    search.any = any;
    search.best_squared = max_distance * max_distance;
    search.rounding = 1e-6F + static_cast<float>(point.cwiseAbs().maxCoeff()) * 2.5e-7F;
    RTCPointQuery query{};
    query.x = static_cast<float>(search.query.x());
    query.y = static_cast<float>(search.query.y());
    query.z = static_cast<float>(search.query.z());
    // Enlarged by the rounding error of the query point, so that no surface at the limit is missed.
    query.radius = upperBound(max_distance * 1.000001 + 1e-6);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, nullptr, &search);
    return search.best;
}

/// After an allocation failure Embree continues with incomplete data, so its scene must not be
/// queried any more.
void throwIfOutOfMemory(RTCDevice device) {
    if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

/// A geometry's buffer of `count` elements; `count` may be 0.
void* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t size,
                std::size_t count) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, size, count);
    if (buffer == nullptr && count > 0) throw std::bad_alloc();
    return buffer;
}

/// Robust: no ray passes between two adjacent triangles. Large scenes take half the memory, for
/// slower queries.
RTCSceneFlags flagsFor(const Scene& scene) {
    const bool large = scene.triangles.size() > kManyTriangles;
    return large ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_ROBUST;
}

}  // namespace

struct RayCaster::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST;
    std::vector<ObjectGeometry> objects;

    Impl(const Scene& source, const Impl* before, const std::vector<int>& moved)
        : device(before ? before->device : rtcNewDevice("threads=0")) {
        if (before) rtcRetainDevice(device);
        scene = rtcNewScene(device);
        flags = flagsFor(source);
        rtcSetSceneFlags(scene, flags);
        objects.resize(source.objects.size());
        parallelFor(objects.size(), [&](std::size_t i) {
            if (!before || std::ranges::binary_search(moved, static_cast<int>(i) + 1)) {
                addObject(source, i);
                return;
            }
            objects[i] = before->objects[i];
            rtcRetainGeometry(objects[i].geometry);
            rtcRetainScene(objects[i].alone);
        });
        for (std::size_t i = 0; i < objects.size(); ++i) {
            rtcAttachGeometryByID(scene, objects[i].geometry, static_cast<unsigned>(i));
        }
        rtcCommitScene(scene);
        throwIfOutOfMemory(device);
    }

    ~Impl() {
        for (ObjectGeometry& object : objects) {
            rtcReleaseScene(object.alone);
            rtcReleaseGeometry(object.geometry);
        }
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void addObject(const Scene& source, std::size_t index) {
        const Object& object = source.objects[index];
        ObjectGeometry& made = objects[index];
        made.geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        made.first_triangle = object.first_triangle;
        auto* vertices =
            static_cast<float*>(newBuffer(made.geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                          3 * sizeof(float), std::max(1U, object.vertex_count)));
        for (std::uint32_t v = 0; v < object.vertex_count; ++v) {
            const Eigen::Vector3f& position = source.positions[object.first_vertex + v];
            std::copy_n(position.data(), 3, vertices + 3UL * v);
        }
        auto* indices =
            static_cast<unsigned*>(newBuffer(made.geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                             3 * sizeof(unsigned), object.triangle_count));
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            for (unsigned k = 0; k < 3; ++k) {
                indices[3UL * t + k] =
                    source.triangles[object.first_triangle + t][k] - object.first_vertex;
            }
        }
        made.vertices = vertices;
        made.indices = indices;
        rtcSetGeometryPointQueryFunction(made.geometry, visitClosest);
        rtcCommitGeometry(made.geometry);
        made.alone = rtcNewScene(device);
        rtcSetSceneFlags(made.alone, flags);
        // Queried much less often than the whole scene, so a fast build matters more than fast
        // queries.
        rtcSetSceneBuildQuality(made.alone, RTC_BUILD_QUALITY_LOW);
        rtcAttachGeometryByID(made.alone, made.geometry, static_cast<unsigned>(index));
        rtcCommitScene(made.alone);
        throwIfOutOfMemory(device);
    }

    [[nodiscard]] RayHit trace(RTCScene target, const RTCRay& ray) const {
        RTCRayHit query{};
        query.ray = ray;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(target, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {static_cast<int>(query.hit.geomID) + 1, query.ray.tfar,
                objects[query.hit.geomID].first_triangle + query.hit.primID};
    }
};

RayCaster::RayCaster(const Scene& scene)
    : impl_(std::make_unique<Impl>(scene, nullptr, std::vector<int>{})) {}
RayCaster::RayCaster(const Scene& scene, const RayCaster& before, const std::vector<int>& moved)
    : impl_(std::make_unique<Impl>(scene, before.impl_.get(), moved)) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

RayHit RayCaster::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                       double max_distance, double min_distance) const {
    return impl_->trace(impl_->scene, makeRay(origin, direction, min_distance, max_distance));
}

void RayCaster::castBundle(const Eigen::Vector3d& origin, std::span<const BundleRay> rays,
                           double min_distance, std::vector<RayHit>& hits) const {
    constexpr std::size_t kPacket = 16;
    hits.resize(rays.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - first);
        RTCRayHit16 packet{};
        alignas(64) int valid[kPacket] = {};
        for (std::size_t i = 0; i < count; ++i) {
            const BundleRay& asked = rays[first + i];
            const RTCRay ray = makeRay(origin, asked.direction, min_distance, asked.max_distance);
            valid[i] = -1;
            packet.ray.org_x[i] = ray.org_x;
            packet.ray.org_y[i] = ray.org_y;
            packet.ray.org_z[i] = ray.org_z;
            packet.ray.dir_x[i] = ray.dir_x;
            packet.ray.dir_y[i] = ray.dir_y;
            packet.ray.dir_z[i] = ray.dir_z;
            packet.ray.tnear[i] = ray.tnear;
            packet.ray.tfar[i] = ray.tfar;
            packet.ray.mask[i] = ray.mask;
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, impl_->scene, &context, &packet);
        for (std::size_t i = 0; i < count; ++i) {
            const unsigned geometry = packet.hit.geomID[i];
            hits[first + i] =
                geometry == RTC_INVALID_GEOMETRY_ID
                    ? RayHit{}
                    : RayHit{static_cast<int>(geometry) + 1, packet.ray.tfar[i],
                             impl_->objects[geometry].first_triangle + packet.hit.primID[i]};
        }
    }
}

bool RayCaster::meetsObject(int object_id, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction, double max_distance) const {
    const auto index = static_cast<std::size_t>(object_id) - 1;
    RTCRay ray = makeRay(origin, direction, 0.0, max_distance);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(impl_->objects[index].alone, &context, &ray);
    return ray.tfar < 0.0F;
}

bool RayCaster::sees(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    RTCRay ray = makeRay(from, to - from, 0.0, 1.0);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(impl_->scene, &context, &ray);
    return ray.tfar >= 0.0F;
}

ClosestPoint RayCaster::closest(const Eigen::Vector3d& point, double max_distance) const {
    return findSurface(impl_->scene, impl_->objects, point, max_distance, false);
}

ClosestPoint RayCaster::closestOn(int object_id, const Eigen::Vector3d& point,
                                  double max_distance) const {
    const auto index = static_cast<std::size_t>(object_id) - 1;
    return findSurface(impl_->objects[index].alone, impl_->objects, point, max_distance, false);
}

bool RayCaster::isClear(const Eigen::Vector3d& point, double distance) const {
    return findSurface(impl_->scene, impl_->objects, point, distance, true).object_id == 0;
}

}  // namespace dollytrack
