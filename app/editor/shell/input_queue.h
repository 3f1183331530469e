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

    /// Before the window asks for events, or waits for them.
    void listen();
    /// Before ImGui's new frame. Returns whether something is left for the next one. With
    /// `hold_keys` what is typed stays in the queue, and what came after it as well.
    bool deliver(bool hold_keys);
    /// After the backend's new frame, which looks at the mouse as it is now: sets its buttons and
    /// its place to what was delivered, and says whether a press follows the one before it closely.
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
        double earliest_s = 0.0, latest_s = 0.0;  // of a button: between these it was moved
    };

    [[nodiscard]] double earliest(double now_s) const;

    GLFWwindow* window_ = nullptr;
    std::deque<Event> events_;
    std::array<bool, 5> down_ = {};  // buttons, as far as delivered
    double x_ = 0.0, y_ = 0.0;       // the mouse, as far as delivered
    bool knows_place_ = false;       // it has moved since the window is there
    bool at_event_ = false;          // a button was pressed or let go there in this frame
    double listens_since_s_ = 0.0;
    double listened_until_s_ = 0.0;  // before that
    std::array<double, 5> pressed_s_ = {-1.0, -1.0, -1.0, -1.0,
                                        -1.0};  // each button's last press, as far as delivered
    bool follows_closely_ = false;              // the press of this frame makes a double click
};

}  // namespace dollytrack::editor
