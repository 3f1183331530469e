#include "render/amodal/silhouette_counter.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/context.h"
#include "render/gl/image.h"
#include "render/gl/shader.h"

#include <GL/glew.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

constexpr std::uint32_t kLevels = 1U << 20U;  // exact in a 32-bit float

constexpr std::int64_t kLarge = 4;  // times the image area: larger objects are subsampled
constexpr int kStep = 4;            // rows and columns per subsample

int stepsUp(int pixels) {
    return (pixels + kStep - 1) / kStep;
}

/// Grows the rectangle to a multiple of kStep from the image's corner.
PixelRect inSteps(const PixelRect& rect) {
    const auto down = [](int value) {
        return kStep * static_cast<int>(std::floor(static_cast<double>(value) / kStep));
    };
    return {down(rect.x0), down(rect.y0), -down(-rect.x1), -down(-rect.y1)};
}

}  // namespace

void SilhouetteCounter::Canvas::resize(int new_width, int new_height) {
    if (new_width == width && new_height == height) return;
    width = new_width;
    height = new_height;
    used = 0;
    depth = gl::createImage(GL_DEPTH_COMPONENT32F, width, height);
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
    pixel_queries_.assign(object_ids.size(), {});
    next_query_ = 0;
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
    // Each object is drawn at a constant depth nearer than all before: a pixel passes the depth
    // test when the object first covers it and never again. This saves clearing the buffer.
    glDepthFunc(GL_GREATER);
    for (std::size_t i = 0; i < object_ids.size(); ++i) {
        const auto object = static_cast<std::size_t>(object_ids[i]) - 1;
        if (scene.bounds[object].isEmpty()) continue;
        const PixelRect rect = projectBox(scene.bounds[object], view, limits);
        if (rect.width() <= 0 || rect.height() <= 0) continue;
        pixel_queries_[i] = startQueries(view, scene.whole_objects[object], rect, limits);
    }
    glDepthRange(0.0, 1.0);
    glDisable(GL_DEPTH_TEST);
    return gl::checkErrors("counting silhouettes");
}

SilhouetteCounter::PixelQueries SilhouetteCounter::startQueries(const View& view,
                                                                const Piece& piece,
                                                                const PixelRect& rect,
                                                                const PixelRect& limits) {
    const PixelRect image{0, 0, view.intrinsics.width, view.intrinsics.height};
    small_.resize(image.width(), image.height());
    if (rect.width() <= image.width() && rect.height() <= image.height()) {
        return {count(cutOut(view, rect), piece, small_), -1, -1};
    }
    large_.resize(limits.width(), limits.height());
    if (rect.area() <= kLarge * image.area()) {
        return {count(cutOut(view, rect), piece, large_), -1, -1};
    }
    const PixelRect steps = inSteps(rect);
    const View sixteenths = cutOut(view, steps, kStep);
    const int x0 = -steps.x0 / kStep;
    const int y0 = -steps.y0 / kStep;
    const PixelRect inside{x0, y0, x0 + stepsUp(image.x1), y0 + stepsUp(image.y1)};
    return {count(cutOut(view, image), piece, small_), count(sixteenths, piece, large_),
            count(sixteenths, piece, large_, &inside)};
}

int SilhouetteCounter::count(const View& part, const Piece& piece, Canvas& canvas,
                             const PixelRect* rect) {
    canvas.begin();
    const double level = canvas.nextLevel();
    glDepthRange(level, level);
    glViewport(0, 0, part.intrinsics.width, part.intrinsics.height);
    setCamera(program_.get(), part);
    if (rect != nullptr) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(rect->x0, rect->y0, rect->width(), rect->height());
    }
    const int query = next_query_++;
    if (query == static_cast<int>(queries_.size())) {
        queries_.push_back(gl::createQuery(GL_SAMPLES_PASSED));
    }
    glBeginQuery(GL_SAMPLES_PASSED, queries_[query].get());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                       static_cast<std::uintptr_t>(piece.first_index) * sizeof(std::uint32_t)));
    glEndQuery(GL_SAMPLES_PASSED);
    glDisable(GL_SCISSOR_TEST);
    return query;
}

std::uint64_t SilhouetteCounter::resultOf(int query) const {
    GLuint64 count = 0;
    if (query < 0) return count;
    glGetQueryObjectui64v(queries_[query].get(), GL_QUERY_RESULT, &count);
    return count;
}

std::vector<std::uint64_t> SilhouetteCounter::finish() {
    std::vector<std::uint64_t> counts;
    for (const PixelQueries& asked : pixel_queries_) {
        const std::uint64_t outside =
            resultOf(asked.sixteenths) - resultOf(asked.sixteenths_inside);
        counts.push_back(resultOf(asked.pixels) + kStep * kStep * outside);
    }
    return counts;
}

}  // namespace dollytrack::render
