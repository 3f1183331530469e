#pragma once

#include <array>
#include <deque>

struct GLFWwindow;

namespace dollytrack::editor {

/// Passes keys, buttons and mouse moves to Dear ImGui in their original order, with at most one
/// change of each key and button per frame (except for keys that type into a text field), and each
/// button event at the mouse position where it happened; a press waits one frame after a move.
/// Otherwise, presses and releases between
/// two frames would be lost, and drags would start where the mouse has got to, which happens with
/// frames of 50 ms.
class InputQueue {
  public:
    /// Installs the window's callbacks. Only one queue per program; it must outlive the window.
    void attach(GLFWwindow* window);

    /// Notes the time at which the program begins to receive events, which tells events that waited
    /// while a frame was drawn from new ones. To be called before polling or waiting for events.
    void listen();
    /// To be called before ImGui's new frame. Returns whether events remain for the next one. With
    /// `hold_keys`, typed keys and everything after them stay in the queue.
    bool deliver(bool hold_keys);
    /// To be called after the backend's new frame, which reads the current mouse: sets buttons and
    /// position to the delivered ones, and whether a press is the second of a double click.
    void setMouse() const;
    [[nodiscard]] bool empty() const { return events_.empty(); }

  private:
    struct Event {
        enum class Kind { Key, Button, Scroll, Text, Move } kind = Kind::Key;
        int code = 0;  // key code, button or character
        int scancode = 0;
        int action = 0;
        int mods = 0;
        double x = 0.0, y = 0.0;
        double earliest_s = 0.0, latest_s = 0.0;  // Button: interval in which it happened
    };

    [[nodiscard]] double earliest(double now_s) const;
    /// Whether a repeat of this key waits for delivery. Then newer ones are dropped, unless a text
    /// field has the keyboard: between slow frames they would pile up, and the key would go on
    /// acting for seconds after its release.
    [[nodiscard]] bool hasRepeat(int key) const;

    GLFWwindow* window_ = nullptr;
    std::deque<Event> events_;
    bool dropped_repeat_ = false;    // the last key event was dropped, so its character is, too
    std::array<bool, 5> down_ = {};  // button states delivered so far
    double x_ = 0.0, y_ = 0.0;       // mouse position delivered so far
    bool knows_place_ = false;       // the mouse has moved since the window opened
    bool at_event_ = false;          // a button event was delivered in this frame
    double listens_since_s_ = 0.0;
    double listened_until_s_ = 0.0;  // end of the previous listening interval
    std::array<double, 5> pressed_s_ = {-1.0, -1.0, -1.0, -1.0,
                                        -1.0};  // each button's last delivered press
    bool follows_closely_ = false;              // the press in this frame completes a double click
};

}  // namespace dollytrack::editor
