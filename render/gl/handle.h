#pragma once

#include <utility>

namespace dollytrack::gl {

/// Owns one OpenGL object by its name. The object's context must be current at creation and
/// destruction.
template <void (*Destroy)(unsigned)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(unsigned name) : name_(name) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }

    [[nodiscard]] unsigned get() const { return name_; }
    void reset() {
        if (name_ != 0) Destroy(name_);
        name_ = 0;
    }

  private:
    unsigned name_ = 0;
};

void destroyBuffer(unsigned name);
void destroyTexture(unsigned name);
void destroyFramebuffer(unsigned name);
void destroyVertexArray(unsigned name);
void destroyProgram(unsigned name);
void destroyQuery(unsigned name);

using Buffer = Handle<destroyBuffer>;
using Texture = Handle<destroyTexture>;
using Framebuffer = Handle<destroyFramebuffer>;
using VertexArray = Handle<destroyVertexArray>;
using Program = Handle<destroyProgram>;
using Query = Handle<destroyQuery>;

[[nodiscard]] Buffer createBuffer();
[[nodiscard]] Texture createTexture(unsigned target);
[[nodiscard]] Framebuffer createFramebuffer();
[[nodiscard]] VertexArray createVertexArray();
[[nodiscard]] Query createQuery(unsigned target);

}  // namespace dollytrack::gl
