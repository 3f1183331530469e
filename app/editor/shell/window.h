#pragma once

#include "app/editor/shell/input_queue.h"
#include "app/editor/shell/panel_navigation.h"
#include "engine/core/result.h"
#include "render/gl/context.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace dollytrack::editor {

/// Window sizes at 96 dots per inch; multiplied by the screen's scale.
struct WindowSettings {
    int width = 1440;
    int height = 900;
    bool maximized = false;
    bool operator==(const WindowSettings&) const = default;
};

/// Where the time of a window frame went, ms.
struct FrameTimes {
    double total_ms = 0.0;
    double widgets_ms = 0.0;    // events, results of the background work, the panels
    double draw_ms = 0.0;       // OpenGL commands for the widgets
    double swap_ms = 0.0;       // until the driver has taken the image
    double processor_ms = 0.0;  // of this thread; less than the total where it waited
};

/// The program's only window, with its OpenGL context, events and Dear ImGui.
class Window {
  public:
    /// Opens the window. Error: NoOpenGl if there is no window system or no OpenGL 4.5, with
    /// advice.
    [[nodiscard]] static Result<std::unique_ptr<Window>> open(const WindowSettings& settings);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// An OpenGL context for another thread that shares nothing with the window's.
    [[nodiscard]] Result<std::unique_ptr<gl::Context>> drawingContext();

    /// Calls `frame` whenever something may have changed, until it returns false. Sleeps otherwise.
    void run(const std::function<bool()>& frame);

    /// Makes run() draw soon. Thread-safe.
    static void wake();

    /// The character that a GLFW key produces on the user's keyboard layout; empty if unknown.
    [[nodiscard]] static std::string signOfKey(int key);

    /// Requests further frames without events, for animations.
    void animate() { frames_to_draw_ = std::max(frames_to_draw_, 2); }
    /// Requests a frame after this time, even without events. Must be requested again in each
    /// frame.
    void drawAfter(double seconds) { draw_within_s_ = std::min(draw_within_s_, seconds); }

    /// Whether input events are queued that no frame has handled yet.
    [[nodiscard]] bool hasInput() const { return !input_.empty(); }
    [[nodiscard]] std::vector<std::string> takeDroppedPaths();
    /// Whether the user asked to close the window, once.
    [[nodiscard]] bool takeCloseRequest();
    [[nodiscard]] bool takeScaleChange();
    /// Scale of all lengths; 1: 96 dots per inch.
    [[nodiscard]] double contentScale() const { return scale_; }
    [[nodiscard]] WindowSettings settings() const;
    [[nodiscard]] const FrameTimes& longestFrame() const { return longest_frame_; }
    [[nodiscard]] double lastFrame_ms() const { return last_frame_.total_ms; }
    [[nodiscard]] long frames() const { return frames_; }
    [[nodiscard]] int glErrors() const { return gl_errors_; }
    /// Restarts the measurement with the next frame. The current frame is not counted, because
    /// answering whoever reads the result takes time.
    void resetLongestFrame() {
        longest_frame_ = {};
        counts_frame_ = false;
    }
    /// Changes the font size from the next frame on; not during a frame.
    void requestFonts(double scale) { wanted_font_scale_ = scale; }
    void setTitle(const std::string& title);
    void toggleFullscreen();
    [[nodiscard]] PanelNavigation& navigation() { return navigation_; }
    [[nodiscard]] GLFWwindow* handle() const { return window_; }

  private:
    static constexpr double kLongestSleep_s = 0.5;  // without events: for display of elapsed time

    Window() = default;
    void drawFrame(const std::function<bool()>& frame, bool& goes_on);
    [[nodiscard]] bool holdsKeys();
    void animateHeldButtons();

    GLFWwindow* window_ = nullptr;
    GLFWwindow* hidden_ = nullptr;
    InputQueue input_;
    PanelNavigation navigation_;
    int held_frames_ = 0;  // frames for which typed keys have been held back for a field
    int frames_to_draw_ = 3;
    double draw_within_s_ = kLongestSleep_s;
    int windowed_[4] = {0, 0, 0, 0};  // position and size before full screen
    std::string title_;
    std::vector<std::string> dropped_;
    double scale_ = 1.0;
    bool scale_changed_ = false;
    double wanted_font_scale_ = 0.0;
    FrameTimes longest_frame_;
    FrameTimes last_frame_;
    bool counts_frame_ = true;  // whether the current frame may be the longest
    long frames_ = 0;
    int gl_errors_ = 0;
};

}  // namespace dollytrack::editor
