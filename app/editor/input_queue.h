#pragma once

#include <array>
#include <deque>

struct GLFWwindow;

namespace dollytrack::editor {

/// Hands keys and buttons to Dear ImGui in the order in which they came, at most one change of
/// each in a frame. Without it, what is pressed and released between two frames is lost: that
/// happens to every fast typist while a frame takes 50 ms.
class InputQueue {
  public:
    /// Takes the window's callbacks. One queue in a program; the window must go before it.
    void attach(GLFWwindow* window);

    /// Before ImGui's new frame. Returns whether something is left for the next one.
    bool deliver();
    /// After the backend's new frame, which looks at the mouse as it is now: sets its buttons to
    /// what was delivered.
    void setButtons() const;
    [[nodiscard]] bool empty() const { return events_.empty(); }

  private:
    struct Event {
        enum class Kind { Key, Button, Scroll, Text } kind = Kind::Key;
        int code = 0;  // key, button or character
        int scancode = 0;
        int action = 0;
        int mods = 0;
        double x = 0.0, y = 0.0;
    };

    GLFWwindow* window_ = nullptr;
    std::deque<Event> events_;
    std::array<bool, 5> down_ = {};  // buttons, as far as delivered
};

}  // namespace dollytrack::editor
