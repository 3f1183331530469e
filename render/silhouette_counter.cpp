#include "render/silhouette_counter.h"

#include "render/gl/context.h"
#include "render/gl/shader.h"
#include "render/view_uniforms.h"

#include <GL/glew.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

constexpr std::uint32_t kLevels = 1U << 20U;  // exact in a 32-bit float

/// Pixels, first included, last not.
struct PixelRect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
};

/// The pixels a box covers, cut at `limits`; all of them when it reaches behind the near plane.
PixelRect projectBox(const Eigen::AlignedBox3f& box, const View& view, const PixelRect& limits) {
    Eigen::AlignedBox2d covered;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d in_world =
            box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)).cast<double>();
        const Eigen::Vector3d in_camera = view.pose.toCamera(in_world);
        if (in_camera.z() < view.near_m) return limits;
        covered.extend(view.project(in_camera));
    }
    const auto clip = [](double value, int low, int high) {
        return static_cast<int>(std::clamp(value, double(low), double(high)));
    };
    return {clip(std::floor(covered.min().x()) - 1, limits.x0, limits.x1),
            clip(std::floor(covered.min().y()) - 1, limits.y0, limits.y1),
            clip(std::ceil(covered.max().x()) + 1, limits.x0, limits.x1),
            clip(std::ceil(covered.max().y()) + 1, limits.y0, limits.y1)};
}

}  // namespace

void SilhouetteCounter::Canvas::resize(int new_width, int new_height) {
    if (new_width == width && new_height == height) return;
    width = new_width;
    height = new_height;
    used = 0;
    depth = gl::createTexture(GL_TEXTURE_2D);
    glTextureStorage2D(depth.get(), 1, GL_DEPTH_COMPONENT32F, width, height);
    frame = gl::createFramebuffer();
    glNamedFramebufferTexture(frame.get(), GL_DEPTH_ATTACHMENT, depth.get(), 0);
    glNamedFramebufferDrawBuffer(frame.get(), GL_NONE);
}

void SilhouetteCounter::Canvas::begin() {
    glBindFramebuffer(GL_FRAMEBUFFER, frame.get());
}

double SilhouetteCounter::Canvas::nextLevel() {
    if (used == 0 || used + 1 >= kLevels) {
        const float zero = 0.0F;
        glClearBufferfv(GL_DEPTH, 0, &zero);
        used = 0;
    }
    return static_cast<double>(++used) / kLevels;
}

Result<SilhouetteCounter> SilhouetteCounter::create() {
    SilhouetteCounter counter;
    Result<gl::Program> program = gl::linkProgram("silhouette.vert", "");
    if (!program) return tl::unexpected(program.error());
    counter.program_ = std::move(*program);
    return counter;
}

Status SilhouetteCounter::start(const GpuScene& scene, const View& view,
                                std::span<const int> object_ids, int beyond) {
    asked_.assign(object_ids.size(), -1);
    if (object_ids.empty()) return {};
    const int width = view.intrinsics.width;
    const int height = view.intrinsics.height;
    int largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const int beyond_x = std::min(beyond * width, (largest - width) / 2);
    const int beyond_y = std::min(beyond * height, (largest - height) / 2);
    const PixelRect limits{-beyond_x, -beyond_y, width + beyond_x, height + beyond_y};

    glUseProgram(program_.get());
    glBindVertexArray(scene.positions_layout.get());
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    // Each object is drawn flat at a depth of its own, nearer than all before: a pixel passes the
    // test the first time the object covers it and never again. That saves clearing the canvas.
    glDepthFunc(GL_GREATER);
    int next_query = 0;
    for (std::size_t i = 0; i < object_ids.size(); ++i) {
        const auto object = static_cast<std::size_t>(object_ids[i]) - 1;
        if (scene.bounds[object].isEmpty()) continue;
        const PixelRect rect = projectBox(scene.bounds[object], view, limits);
        if (rect.width() <= 0 || rect.height() <= 0) continue;
        const bool fits = rect.width() <= width && rect.height() <= height;
        Canvas& canvas = fits ? small_ : large_;
        canvas.resize(fits ? width : limits.width(), fits ? height : limits.height());
        canvas.begin();
        const double level = canvas.nextLevel();
        glDepthRange(level, level);
        glViewport(0, 0, rect.width(), rect.height());
        View moved;
        moved.pose = view.pose;
        moved.near_m = view.near_m;
        moved.orthographic = view.orthographic;
        moved.intrinsics = view.intrinsics;
        moved.intrinsics.width = rect.width();
        moved.intrinsics.height = rect.height();
        moved.intrinsics.cx -= rect.x0;
        moved.intrinsics.cy -= rect.y0;
        setCamera(program_.get(), moved);
        if (next_query == static_cast<int>(queries_.size())) {
            queries_.push_back(gl::createQuery(GL_SAMPLES_PASSED));
        }
        asked_[i] = next_query++;
        glBeginQuery(GL_SAMPLES_PASSED, queries_[static_cast<std::size_t>(asked_[i])].get());
        const Piece& piece = scene.whole_objects[object];
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                           static_cast<std::uintptr_t>(piece.first_index) * sizeof(std::uint32_t)));
        glEndQuery(GL_SAMPLES_PASSED);
    }
    glDepthRange(0.0, 1.0);
    glDisable(GL_DEPTH_TEST);
    return gl::checkErrors("counting silhouettes");
}

std::vector<std::uint64_t> SilhouetteCounter::finish() {
    std::vector<std::uint64_t> counts(asked_.size(), 0);
    for (std::size_t i = 0; i < asked_.size(); ++i) {
        if (asked_[i] < 0) continue;
        GLuint64 count = 0;
        glGetQueryObjectui64v(queries_[static_cast<std::size_t>(asked_[i])].get(), GL_QUERY_RESULT,
                              &count);
        counts[i] = count;
    }
    return counts;
}

}  // namespace dollytrack::render
