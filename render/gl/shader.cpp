#include "render/gl/shader.h"

#include <GL/glew.h>

#include <algorithm>

namespace dollytrack::gl {
namespace {

class Stage {
  public:
    explicit Stage(unsigned kind) : name_(glCreateShader(kind)) {}
    ~Stage() { glDeleteShader(name_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    [[nodiscard]] unsigned get() const { return name_; }

    Status compile(std::string_view file, std::span<const std::string> defined = {}) const {
        std::string source(shaderSource(file));
        // Macros follow the #version line, which must come first.
        for (const std::string& word : defined) {
            source.insert(source.find('\n') + 1, "#define " + word + "\n");
        }
        const char* text = source.data();
        const auto length = static_cast<GLint>(source.size());
        glShaderSource(name_, 1, &text, &length);
        glCompileShader(name_);
        GLint done = 0;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &done);
        if (done == GL_TRUE) return {};
        GLint size = 0;
        glGetShaderiv(name_, GL_INFO_LOG_LENGTH, &size);
        std::string words(static_cast<std::size_t>(std::max(size, 1)), '\0');
        glGetShaderInfoLog(name_, size, nullptr, words.data());
        return fail(ErrorCode::Failed, "the shader does not compile: " + words, std::string(file));
    }

  private:
    unsigned name_;
};

}  // namespace

Result<Program> linkProgram(std::string_view vertex, std::string_view fragment,
                            std::span<const std::string> defined) {
    Program program(glCreateProgram());
    const Stage vertex_stage(GL_VERTEX_SHADER);
    if (Status status = vertex_stage.compile(vertex); !status) {
        return tl::unexpected(status.error());
    }
    const Stage fragment_stage(GL_FRAGMENT_SHADER);
    glAttachShader(program.get(), vertex_stage.get());
    if (!fragment.empty()) {
        if (Status status = fragment_stage.compile(fragment, defined); !status) {
            return tl::unexpected(status.error());
        }
        glAttachShader(program.get(), fragment_stage.get());
    }
    glLinkProgram(program.get());
    GLint done = 0;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &done);
    if (done == GL_TRUE) return program;
    std::string words(4096, '\0');
    GLsizei size = 0;
    glGetProgramInfoLog(program.get(), 4096, &size, words.data());
    words.resize(size);
    // A damaged entry in Mesa's cache of compiled shaders shows as a failure to link.
    return fail(ErrorCode::Failed,
                "the shaders do not link: " + words +
                    "; if Mesa's shader cache is damaged, remove ~/.cache/mesa_shader_cache",
                std::string(vertex));
}

}  // namespace dollytrack::gl
