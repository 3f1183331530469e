#include "app/editor/shell/input_queue.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <limits>
#include <set>

namespace dollytrack::editor {
namespace {

constexpr double kDoubleClick_s = 0.3;

InputQueue* the_queue = nullptr;

/// Whether a key only types a character into a text field, so that its presses and releases need no
/// frames of their own. Shift counts, because the character already depends on it.
bool onlyTypes(int key, int mods) {
    if (!ImGui::GetIO().WantTextInput) return false;
    if ((mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) return false;
    return (key >= GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2) ||
           (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_ADD) || key == GLFW_KEY_LEFT_SHIFT ||
           key == GLFW_KEY_RIGHT_SHIFT;
}

/// Whether a key changes the meaning of others instead of having one itself.
bool isModifier(int key) {
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

}  // namespace

void InputQueue::attach(GLFWwindow* window) {
    the_queue = this;
    window_ = window;
    glfwSetKeyCallback(window, [](GLFWwindow*, int key, int scancode, int action, int mods) {
        the_queue->dropped_repeat_ =
            action == GLFW_REPEAT && !ImGui::GetIO().WantTextInput && the_queue->hasRepeat(key);
        if (the_queue->dropped_repeat_) return;
        the_queue->events_.push_back({Event::Kind::Key, key, scancode, action, mods});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow*, int button, int action, int mods) {
        const double now_s = glfwGetTime();
        the_queue->events_.push_back({Event::Kind::Button, button, 0, action, mods, 0, 0,
                                      the_queue->earliest(now_s), now_s});
    });
    glfwSetScrollCallback(window, [](GLFWwindow*, double x, double y) {
        the_queue->events_.push_back({Event::Kind::Scroll, 0, 0, 0, 0, x, y});
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow*, double x, double y) {
        std::deque<Event>& events = the_queue->events_;
        // Only positions at other events and the latest position matter.
        if (!events.empty() && events.back().kind == Event::Kind::Move) events.pop_back();
        events.push_back({Event::Kind::Move, 0, 0, 0, 0, x, y});
    });
    glfwSetCharCallback(window, [](GLFWwindow*, unsigned character) {
        if (the_queue->dropped_repeat_) return;
        the_queue->events_.push_back({Event::Kind::Text, static_cast<int>(character)});
    });
    glfwSetCursorEnterCallback(window, ImGui_ImplGlfw_CursorEnterCallback);
    glfwSetWindowFocusCallback(window, ImGui_ImplGlfw_WindowFocusCallback);
}

bool InputQueue::hasRepeat(int key) const {
    return std::ranges::any_of(events_, [&](const Event& event) {
        return event.kind == Event::Kind::Key && event.code == key && event.action == GLFW_REPEAT;
    });
}

void InputQueue::listen() {
    listens_since_s_ = glfwGetTime();
}

double InputQueue::earliest(double now_s) const {
    // Events reported immediately were queued while the last frame was drawn.
    constexpr double kAtOnce_s = 0.005;
    return now_s - listens_since_s_ < kAtOnce_s ? listened_until_s_ : now_s;
}

bool InputQueue::deliver(bool hold_keys) {
    listened_until_s_ = glfwGetTime();
    follows_closely_ = false;
    std::set<int> changed;     // key codes, and buttons as negative numbers
    std::set<int> released;    // codes of keys
    bool key_pressed = false;  // a key that is no modifier
    at_event_ = false;         // after a button event, the mouse must not move in this frame
    bool moved = false;        // the mouse moved in this frame
    bool dragged = false;      // the final position must be shown before the button is released
    bool scrolled = false;     // the wheel was turned in this frame
    bool text = false;         // characters were delivered, which later keys must not overtake
    while (!events_.empty()) {
        const Event event = events_.front();
        const bool typed = event.kind == Event::Kind::Text ||
                           (event.kind == Event::Kind::Key && event.action != GLFW_RELEASE);
        if (typed && hold_keys) return true;
        // After a wheel event, moves and clicks wait for the next frame: the wheel scrolls the
        // panel under the mouse, and a click must hit what lies there after scrolling.
        const bool waits_for_wheel =
            scrolled && (event.kind == Event::Kind::Move || event.kind == Event::Kind::Button);
        if (waits_for_wheel || (event.kind == Event::Kind::Move && at_event_)) return true;
        if (event.kind == Event::Kind::Button && event.action == GLFW_RELEASE && dragged) {
            return true;
        }
        // ImGui ignores a press on an item that others may overlap, like a row of a list, unless
        // the mouse was over it in the frame before.
        if (event.kind == Event::Kind::Button && event.action == GLFW_PRESS && moved) return true;
        const bool types = event.kind == Event::Kind::Text ||
                           (event.kind == Event::Kind::Key && onlyTypes(event.code, event.mods));
        // Text fields handle characters before keys, and lose the keyboard before both when another
        // widget is clicked.
        const bool must_wait = types ? !changed.empty() : event.kind != Event::Kind::Move && text;
        if (must_wait) return true;
        const bool switches =
            !types && (event.kind == Event::Kind::Key || event.kind == Event::Kind::Button);
        const bool repeats = event.action == GLFW_REPEAT;
        const int which = event.kind == Event::Kind::Button ? -1 - event.code : event.code;
        // A second change of a key, or a release after other presses, needs a frame of its own:
        // otherwise Ctrl could be released before its key is handled. ImGui knows only which keys
        // are down in a frame, so it would not notice a key that is released and pressed again
        // within one. Two keys need two frames, because only one command runs in each.
        const bool release = event.action == GLFW_RELEASE;
        const bool key = event.kind == Event::Kind::Key;
        const bool waits_for_change =
            release ? !changed.empty()
                    : changed.contains(which) || released.contains(which) || (key && key_pressed);
        if (switches && !repeats && waits_for_change) return true;
        events_.pop_front();
        if (switches && !repeats) {
            if (key && release) {
                released.insert(which);
            } else {
                // Button releases count, too: the second press of a double click needs a frame of
                // its own.
                changed.insert(which);
                key_pressed |= key && !isModifier(event.code);
            }
        }
        switch (event.kind) {
            case Event::Kind::Key:
                ImGui_ImplGlfw_KeyCallback(window_, event.code, event.scancode, event.action,
                                           event.mods);
                break;
            case Event::Kind::Button:
                if (event.code >= 0 && event.code < static_cast<int>(down_.size())) {
                    const std::size_t button = event.code;
                    down_[button] = event.action == GLFW_PRESS;
                    if (down_[button]) {
                        follows_closely_ = event.earliest_s - pressed_s_[button] < kDoubleClick_s;
                        pressed_s_[button] = event.latest_s;
                    }
                }
                ImGui_ImplGlfw_MouseButtonCallback(window_, event.code, event.action, event.mods);
                at_event_ = true;
                break;
            case Event::Kind::Scroll:
                scrolled = true;
                ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
                break;
            case Event::Kind::Text:
                text = true;
                ImGui_ImplGlfw_CharCallback(window_, static_cast<unsigned>(event.code));
                break;
            case Event::Kind::Move:
                moved = moved || event.x != x_ || event.y != y_;
                x_ = event.x;
                y_ = event.y;
                knows_place_ = true;
                dragged = std::ranges::find(down_, true) != down_.end();
                break;
        }
    }
    return false;
}

void InputQueue::setMouse() const {
    // The current mouse is ahead of the delivered events: a double click within a slow frame would
    // be one click, clicks would overtake typed letters, and drags would start at the wrong
    // position.
    ImGuiIO& io = ImGui::GetIO();
    for (std::size_t i = 0; i < down_.size(); ++i) io.MouseDown[i] = down_[i];
    // ImGui's clock counts frames, so a double click during slow frames would be two clicks.
    io.MouseDoubleClickTime = follows_closely_ ? std::numeric_limits<float>::max() : 0.0F;
    const bool behind = at_event_ || !events_.empty();
    if (behind && knows_place_ && ImGui::IsMousePosValid(&io.MousePos)) {
        io.MousePos = {static_cast<float>(x_), static_cast<float>(y_)};
    }
}

}  // namespace dollytrack::editor
