#pragma once

#include "app/editor/shell/input_queue.h"
#include "engine/core/result.h"
#include "render/gl/context.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace dollytrack::editor {

/// Sizes at 96 dots per inch; a larger screen scale makes the window larger by as much.
struct WindowSettings {
    int width = 1440;
    int height = 900;
    bool maximized = false;
    bool operator==(const WindowSettings&) const = default;
};

/// The window with its OpenGL context, its events and Dear ImGui. One in a program.
class Window {
  public:
    /// NoOpenGl when there is no window system, or no OpenGL 4.5, with what to do about it.
    [[nodiscard]] static Result<std::unique_ptr<Window>> open(const WindowSettings& settings);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// A second context, for another thread, that shares nothing with the window's.
    [[nodiscard]] Result<std::unique_ptr<gl::Context>> drawingContext();

    /// Calls `frame` whenever there is something to show, until it returns false. Sleeps while
    /// nothing happens.
    void run(const std::function<bool()>& frame);

    /// Makes run() draw soon. From any thread.
    static void wake();

    /// What a key (of GLFW's numbers) writes on the user's keyboard; empty where that is not known.
    [[nodiscard]] static std::string signOfKey(int key);

    /// Keeps drawing for a while without events: while something moves by itself.
    void animate() { frames_to_draw_ = std::max(frames_to_draw_, 2); }

    /// Keys and clicks have arrived that no frame has seen yet.
    [[nodiscard]] bool hasInput() const { return !input_.empty(); }
    [[nodiscard]] std::vector<std::string> takeDroppedPaths();
    /// Whether the user asked to close the window; asking resets it.
    [[nodiscard]] bool takeCloseRequest();
    [[nodiscard]] bool takeScaleChange();
    /// Of all lengths; 1: 96 dots per inch.
    [[nodiscard]] double contentScale() const { return scale_; }
    [[nodiscard]] WindowSettings settings() const;
    [[nodiscard]] double longestFrame_ms() const { return longest_frame_ms_; }
    [[nodiscard]] double lastFrame_ms() const { return last_frame_ms_; }
    [[nodiscard]] long frames() const { return frames_; }
    [[nodiscard]] int glErrors() const { return gl_errors_; }
    void resetLongestFrame() { longest_frame_ms_ = 0.0; }
    /// Fonts of another size from the next frame on; not within one.
    void requestFonts(double scale) { wanted_font_scale_ = scale; }
    void setTitle(const std::string& title);
    void toggleFullscreen();
    [[nodiscard]] GLFWwindow* handle() const { return window_; }

  private:
    Window() = default;
    void drawFrame(const std::function<bool()>& frame, bool& goes_on);
    [[nodiscard]] bool holdsKeys();

    GLFWwindow* window_ = nullptr;
    GLFWwindow* hidden_ = nullptr;
    InputQueue input_;
    int held_frames_ = 0;  // for which what is typed waits until a field has the keyboard
    int frames_to_draw_ = 3;
    int windowed_[4] = {0, 0, 0, 0};  // place and size before full screen
    std::string title_;
    std::vector<std::string> dropped_;
    double scale_ = 1.0;
    bool scale_changed_ = false;
    double wanted_font_scale_ = 0.0;
    double longest_frame_ms_ = 0.0;
    double last_frame_ms_ = 0.0;
    long frames_ = 0;
    int gl_errors_ = 0;
};

}  // namespace dollytrack::editor
