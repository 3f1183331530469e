#include "app/editor/shell/window.h"
#include "engine/core/log.h"
#include "render/gl/egl_context.h"
#include "render/gl/picture_texture.h"
#include "ui/screen_scale.h"
#include "ui/theme.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/keyboard_wait.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>
#include <utility>

namespace dollytrack::editor {
namespace {

std::string last_glfw_error;
std::atomic<bool> woken = false;  // set by wake() since the last wait

void onGlfwError(int, const char* description) {
    last_glfw_error = description;
}

class HiddenWindow : public gl::Context {
  public:
    explicit HiddenWindow(GLFWwindow* window) : window_(window) {}
    ~HiddenWindow() override { glfwMakeContextCurrent(nullptr); }
    Status makeCurrent() override {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() == window_) return {};
        return fail(
            ErrorCode::NoOpenGl,
            "the OpenGL context for drawing in the background cannot be used: " + last_glfw_error);
    }

  private:
    GLFWwindow* window_;
};

/// Scale for a screen; 1 without a screen.
double scaleOf(GLFWmonitor* monitor) {
    if (monitor == nullptr) return 1.0;
    float content_x = 1.0F;
    float content_y = 1.0F;
    glfwGetMonitorContentScale(monitor, &content_x, &content_y);
    ui::ScreenSize screen;
    glfwGetMonitorPhysicalSize(monitor, &screen.width_mm, &screen.height_mm);
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) {
        screen.width_px = mode->width;
        screen.height_px = mode->height;
    }
    return ui::screenScale(content_x, screen);
}

/// The screen that contains the largest part of the window.
GLFWmonitor* monitorUnder(GLFWwindow* window) {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    glfwGetWindowPos(window, &x, &y);
    glfwGetWindowSize(window, &width, &height);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    long most = 0;
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (mode == nullptr) continue;
        int left = 0;
        int top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const long wide = std::min(x + width, left + mode->width) - std::max(x, left);
        const long high = std::min(y + height, top + mode->height) - std::max(y, top);
        if (wide <= 0 || high <= 0 || wide * high <= most) continue;
        most = wide * high;
        best = monitors[i];
    }
    return best;
}

/// A length in pixels of this screen, at most the screen's size.
int onScreen(int length, double scale, int most) {
    return std::min(static_cast<int>(std::lround(length * scale)), most);
}

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Processor time that the calling thread has used.
double processorTime_ms() {
    timespec used{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const WindowSettings& settings) {
    glfwSetErrorCallback(onGlfwError);
    if (glfwInit() == GLFW_FALSE) {
        return fail(ErrorCode::NoOpenGl,
                    "There is no window system (" + last_glfw_error +
                        "); start it in a desktop session, or use the program 'dollytrack', which "
                        "needs none.");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    if (settings.maximized) glfwWindowHint(GLFW_MAXIMIZED, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "dollytrack-editor");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "dollytrack-editor");
    auto window = std::unique_ptr<Window>(new Window);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    const double scale = scaleOf(monitor);
    const int most_width = mode != nullptr ? mode->width : 16384;
    const int most_height = mode != nullptr ? mode->height : 16384;
    window->scale_ = scale;
    window->window_ = glfwCreateWindow(onScreen(settings.width, scale, most_width),
                                       onScreen(settings.height, scale, most_height), "Dollytrack",
                                       nullptr, nullptr);
    if (window->window_ == nullptr) {
        return fail(ErrorCode::NoOpenGl,
                    "This display offers no OpenGL 4.5 (" + last_glfw_error +
                        "); update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1 to render "
                        "on the CPU.");
    }
    glfwSetWindowSizeLimits(window->window_, onScreen(800, scale, most_width),
                            onScreen(500, scale, most_height), GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window->window_);
    glfwSwapInterval(1);
    if (Status status = gl::loadFunctions(); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    glfwSetWindowUserPointer(window->window_, window.get());
    glfwSetDropCallback(window->window_, [](GLFWwindow* handle, int count, const char** paths) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        self->dropped_.insert(self->dropped_.end(), paths, paths + count);
    });
    glfwSetWindowContentScaleCallback(window->window_, [](GLFWwindow* handle, float, float) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        self->scale_ = scaleOf(monitorUnder(handle));
        self->scale_changed_ = true;
    });
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;        // the layout is stored in our settings
    ImGui::GetIO().MouseDoubleClickTime = 0.4F;  // usual desktop value, above ImGui's default
    ImGui_ImplGlfw_InitForOpenGL(window->window_, false);
    window->input_.attach(window->window_);
    ImGui_ImplOpenGL3_Init("#version 450");
    return window;
}

Window::~Window() {
    if (window_ != nullptr && ImGui::GetCurrentContext() != nullptr) {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    if (hidden_ != nullptr) glfwDestroyWindow(hidden_);
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
}

Result<std::unique_ptr<gl::Context>> Window::drawingContext() {
    // Mesa's software driver keeps one list of the contexts of all windows and accesses other
    // threads' contexts without locks: only a context without a window is safe.
    if (gl::drawsByProcessor()) {
        auto apart = gl::createEglContext();
        if (apart) return apart;
        log::warn("editor",
                  "Rendering shares the window's OpenGL driver, which may crash occasionally: " +
                      apart.error().message);
    }
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_MAXIMIZED, GLFW_FALSE);
    hidden_ = glfwCreateWindow(16, 16, "Dollytrack drawing", nullptr, nullptr);
    glfwMakeContextCurrent(window_);
    if (hidden_ == nullptr) {
        return fail(ErrorCode::NoOpenGl,
                    "the OpenGL context for drawing in the background cannot be created: " +
                        last_glfw_error);
    }
    return std::unique_ptr<gl::Context>(std::make_unique<HiddenWindow>(hidden_));
}

std::string Window::signOfKey(int key) {
    const char* name = glfwGetKeyName(key, 0);
    return name != nullptr ? name : "";
}

void Window::wake() {
    woken = true;
    glfwPostEmptyEvent();
}

void Window::run(const std::function<bool()>& frame) {
    constexpr double kBlink_s = 0.2;    // while a text cursor blinks
    constexpr double kFrame_ms = 15.0;  // frame limit if the driver does not wait for the screen
    bool goes_on = true;
    while (goes_on) {
        input_.listen();
        if (frames_to_draw_ > 0) {
            glfwPollEvents();
            woken = false;
            --frames_to_draw_;
        } else {
            const double blink_s = ImGui::GetIO().WantTextInput ? kBlink_s : kLongestSleep_s;
            const double sleep_s = std::min(blink_s, draw_within_s_);
            const auto begin = Clock::now();
            glfwWaitEventsTimeout(sleep_s);
            const bool by_work = woken.exchange(false) && input_.empty();
            // ImGui needs a few frames to react to an event. Unneeded frames would slow down the
            // background work.
            if (!by_work && millisecondsSince(begin) < 1000.0 * sleep_s) frames_to_draw_ = 3;
        }
        counts_frame_ = true;
        drawFrame(frame, goes_on);
        if (counts_frame_ && last_frame_.total_ms > longest_frame_.total_ms) {
            longest_frame_ = last_frame_;
        }
        ++frames_;
        if (last_frame_.total_ms < kFrame_ms) {
            std::this_thread::sleep_for(
                std::chrono::duration<double, std::milli>(kFrame_ms - last_frame_.total_ms));
        }
    }
}

bool Window::holdsKeys() {
    // More than any field needs: a field that never gets the keyboard must not block it. Counted in
    // frames, since one may last a second.
    constexpr int kMost = 120;
    held_frames_ = ui::takeKeyboardAwaited() ? held_frames_ + 1 : 0;
    return held_frames_ > 0 && held_frames_ < kMost;
}

void Window::animateHeldButtons() {
    // With the right or middle button held, keys fly the view. A held left button needs frames for
    // repeating step buttons; drags are drawn by mouse events.
    constexpr double kHeld_s = 0.05;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
        animate();
    } else if (ImGui::IsAnyMouseDown()) {
        drawAfter(kHeld_s);
    }
}

void Window::drawFrame(const std::function<bool()>& frame, bool& goes_on) {
    const auto begin = Clock::now();
    const double processor_before_ms = processorTime_ms();
    if (wanted_font_scale_ > 0.0) {
        ui::loadFonts(std::exchange(wanted_font_scale_, 0.0));
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    if (input_.deliver(holdsKeys())) animate();
    ui::item_map::beginFrame();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    input_.setMouse();
    navigation_.beginFrame();
    ImGui::NewFrame();
    draw_within_s_ = kLongestSleep_s;
    goes_on = frame();
    animateHeldButtons();
    ImGui::Render();
    ui::item_map::endFrame();
    last_frame_.widgets_ms = millisecondsSince(begin);
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const ImVec4 color = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
    gl::clearWindow(width, height, color.x, color.y, color.z);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (const Status status = gl::checkErrors("drawing the window"); !status) {
        ++gl_errors_;
        log::error("editor", status.error().message);
    }
    last_frame_.draw_ms = millisecondsSince(begin) - last_frame_.widgets_ms;
    glfwSwapBuffers(window_);
    last_frame_.processor_ms = processorTime_ms() - processor_before_ms;
    last_frame_.total_ms = millisecondsSince(begin);
    last_frame_.swap_ms = last_frame_.total_ms - last_frame_.widgets_ms - last_frame_.draw_ms;
}

std::vector<std::string> Window::takeDroppedPaths() {
    return std::exchange(dropped_, {});
}

bool Window::takeCloseRequest() {
    const bool asked = glfwWindowShouldClose(window_) == GLFW_TRUE;
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return asked;
}

bool Window::takeScaleChange() {
    return std::exchange(scale_changed_, false);
}

WindowSettings Window::settings() const {
    WindowSettings now;
    now.maximized = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE;
    glfwGetWindowSize(window_, &now.width, &now.height);
    // In the units of open(); otherwise the window would grow with each start.
    now.width = static_cast<int>(std::lround(now.width / scale_));
    now.height = static_cast<int>(std::lround(now.height / scale_));
    return now;
}

void Window::setTitle(const std::string& title) {
    // Setting the title causes an event, which would wake the window forever.
    if (std::exchange(title_, title) != title) glfwSetWindowTitle(window_, title.c_str());
}

void Window::toggleFullscreen() {
    if (glfwGetWindowMonitor(window_) != nullptr) {
        glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2],
                             windowed_[3], 0);
        return;
    }
    glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
    glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return;
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

}  // namespace dollytrack::editor
