#include "render/draw/passes/occlusion_culling.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/shader.h"

#include <GL/glew.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace dollytrack::render {
namespace {

constexpr std::uint32_t kWorthwhile = 100'000;  // triangles in view: below this, waiting costs more
                                                // than it saves
constexpr unsigned kImages = 5;                 // colour images of a surface buffer with labels
constexpr std::uint32_t kLarge = 256;           // triangles: smaller objects are not tested

/// The object's box, grown by more than a pixel to cover multisample positions and parts thinner
/// than a pixel. Empty if the box reaches behind the near plane.
std::optional<Eigen::AlignedBox3f> boxToAsk(const Eigen::AlignedBox3f& bounds, const View& view) {
    double nearest = std::numeric_limits<double>::max();
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d at =
            bounds.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)).cast<double>();
        const double z = view.pose.toCamera(at).z();
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    const double pixel_m = view.orthographic
                               ? 1.0 / view.orthographic->px_per_m
                               : farthest / std::min(view.intrinsics.fx, view.intrinsics.fy);
    const auto wider = Eigen::Vector3f::Constant(static_cast<float>(1.5 * pixel_m));
    if (nearest - 2.0 * wider.norm() < view.near_m) return std::nullopt;
    return Eigen::AlignedBox3f(bounds.min() - wider, bounds.max() + wider);
}

}  // namespace

Result<OcclusionCulling> OcclusionCulling::create() {
    OcclusionCulling culling;
    Result<gl::Program> box = gl::linkProgram("box.vert", "");
    if (!box) return tl::unexpected(box.error());
    culling.box_ = std::move(*box);
    culling.no_vertices_ = gl::createVertexArray();
    return culling;
}

void OcclusionCulling::start(const GpuScene& scene, const View& view,
                             const std::vector<bool>& in_view) {
    occlusion_tests_.clear();
    hidden_ = 0;
    answered_ = true;
    std::uint32_t triangles = 0;
    for (std::size_t i = 0; i < in_view.size(); ++i) {
        if (in_view[i]) triangles += scene.whole_objects[i].index_count / 3;
    }
    if (triangles < kWorthwhile) return;
    glUseProgram(box_.get());
    setCamera(box_.get(), view);
    glBindVertexArray(no_vertices_.get());
    glDepthMask(GL_FALSE);
    for (unsigned i = 0; i < kImages; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (std::size_t i = 0; i < in_view.size(); ++i) {
        if (!in_view[i] || scene.whole_objects[i].index_count / 3 < kLarge) continue;
        const std::optional<Eigen::AlignedBox3f> box = boxToAsk(scene.bounds[i], view);
        if (!box) continue;
        if (occlusion_tests_.size() == queries_.size()) {
            queries_.push_back(gl::createQuery(GL_ANY_SAMPLES_PASSED));
        }
        glProgramUniform3fv(box_.get(), 4, 1, box->min().data());
        glProgramUniform3fv(box_.get(), 5, 1, box->max().data());
        glBeginQuery(GL_ANY_SAMPLES_PASSED, queries_[occlusion_tests_.size()].get());
        glDrawArrays(GL_TRIANGLES, 0, 36);
        glEndQuery(GL_ANY_SAMPLES_PASSED);
        occlusion_tests_.push_back({i});
    }
    for (unsigned i = 0; i < kImages; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glBindVertexArray(scene.layout.get());
    answered_ = false;
}

void OcclusionCulling::takeHidden(std::vector<bool>& in_view) {
    for (std::size_t i = 0; i < occlusion_tests_.size() && !answered_; ++i) {
        GLuint seen = 0;
        glGetQueryObjectuiv(queries_[i].get(), GL_QUERY_RESULT, &seen);
        occlusion_tests_[i].hidden = seen == 0;
        hidden_ += seen == 0 ? 1 : 0;
    }
    answered_ = true;
    for (const OcclusionTest& asked : occlusion_tests_) {
        if (asked.hidden) in_view[asked.object] = false;
    }
}

}  // namespace dollytrack::render
