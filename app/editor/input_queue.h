#pragma once

#include <array>
#include <deque>

struct GLFWwindow;

namespace dollytrack::editor {

/// Hands keys, buttons and the mouse's way to Dear ImGui in the order in which they came, at most
/// one change of each key and button in a frame, and a button where the mouse was when it was
/// pressed. Without it, what is pressed and released between two frames is lost, and a drag begins
/// where the mouse has got to: that happens to every fast hand while a frame takes 50 ms.
class InputQueue {
  public:
    /// Takes the window's callbacks. One queue in a program; the window must go before it.
    void attach(GLFWwindow* window);

    /// Before ImGui's new frame. Returns whether something is left for the next one. With
    /// `hold_keys` what is typed stays in the queue, and what came after it as well.
    bool deliver(bool hold_keys);
    /// After the backend's new frame, which looks at the mouse as it is now: sets its buttons and
    /// its place to what was delivered.
    void setMouse() const;
    [[nodiscard]] bool empty() const { return events_.empty(); }

  private:
    struct Event {
        enum class Kind { Key, Button, Scroll, Text, Move } kind = Kind::Key;
        int code = 0;  // key, button or character
        int scancode = 0;
        int action = 0;
        int mods = 0;
        double x = 0.0, y = 0.0;
    };

    GLFWwindow* window_ = nullptr;
    std::deque<Event> events_;
    std::array<bool, 5> down_ = {};  // buttons, as far as delivered
    double x_ = 0.0, y_ = 0.0;       // the mouse, as far as delivered
    bool knows_place_ = false;       // it has moved since the window is there
    bool at_event_ = false;          // a button was pressed or let go there in this frame
};

}  // namespace dollytrack::editor
