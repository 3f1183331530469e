#include "render/draw/passes/glass_order.h"

#include <GL/glew.h>

#include <algorithm>

namespace dollytrack::render {
namespace {

struct Sheet {
    float distance = 0.0F;  // to the nearest point of its box
    float middle = 0.0F;    // to the centre of its box
    std::size_t index = 0;
    std::uint32_t first_corner = 0;
};

/// Distances from the camera position to the box's nearest point and to its centre. In an
/// orthographic view they are measured along the viewing axis.
std::pair<float, float> distancesTo(const Eigen::AlignedBox3f& box, const View& view) {
    const Eigen::Vector3f eye = view.pose.position.cast<float>();
    if (!view.orthographic) {
        return {box.exteriorDistance(eye), (box.center() - eye).norm()};
    }
    const Eigen::Vector3f forward = (view.pose.rotation * Eigen::Vector3d::UnitZ()).cast<float>();
    const float middle = forward.dot(box.center() - eye);
    return {middle - 0.5F * forward.cwiseAbs().dot(box.sizes()), middle};
}

}  // namespace

void GlassOrder::visit(
    const GpuScene& scene, const View& view, const std::vector<bool>& visible,
    const std::function<void(const Batch&, std::uint32_t, std::uint32_t)>& draw) {
    std::vector<Sheet> sheets;
    std::uint32_t corner = 0;
    for (std::size_t i = 0; i < scene.glass.size(); ++i) {
        const GlassSheet& sheet = scene.glass[i];
        if (visible[sheet.object_id - 1]) {
            const auto [distance, middle] = distancesTo(sheet.bounds, view);
            sheets.push_back({distance, middle, i, corner});
        }
        corner += sheet.index_count;
    }
    if (sheets.empty()) return;
    std::ranges::sort(sheets, [](const Sheet& a, const Sheet& b) {
        if (a.distance != b.distance) return a.distance > b.distance;
        return a.middle != b.middle ? a.middle > b.middle : a.index < b.index;
    });
    sorted_.clear();
    for (const Sheet& sheet : sheets) {
        const auto first = scene.glass_corners.begin() + sheet.first_corner;
        sorted_.insert(sorted_.end(), first, first + scene.glass[sheet.index].index_count);
    }
    if (capacity_ < scene.glass_corners.size()) {
        capacity_ = scene.glass_corners.size();
        indices_ = gl::createBuffer();
        glNamedBufferStorage(indices_.get(),
                             static_cast<GLsizeiptr>(capacity_ * sizeof(std::uint32_t)), nullptr,
                             GL_DYNAMIC_STORAGE_BIT);
    }
    glNamedBufferSubData(indices_.get(), 0,
                         static_cast<GLsizeiptr>(sorted_.size() * sizeof(std::uint32_t)),
                         sorted_.data());
    glVertexArrayElementBuffer(scene.layout.get(), indices_.get());
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < sheets.size();) {
        const std::size_t batch = scene.glass[sheets[i].index].batch;
        std::uint32_t count = 0;
        for (; i < sheets.size() && scene.glass[sheets[i].index].batch == batch; ++i) {
            count += scene.glass[sheets[i].index].index_count;
        }
        draw(scene.batches[batch], first, count);
        first += count;
    }
    glVertexArrayElementBuffer(scene.layout.get(), scene.indices.get());
}

}  // namespace dollytrack::render
