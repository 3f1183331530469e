#include "render/silhouette_counter.h"

#include "render/gl/context.h"
#include "render/gl/shader.h"
#include "render/projected_box.h"
#include "render/view_uniforms.h"

#include <GL/glew.h>

#include <algorithm>

namespace dollytrack::render {
namespace {

constexpr std::uint32_t kLevels = 1U << 20U;  // exact in a 32-bit float

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
        setCamera(program_.get(), cutOut(view, rect));
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
