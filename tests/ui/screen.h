#pragma once

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <functional>
#include <optional>
#include <string>

struct ImGuiContext;

namespace dollytrack::test {

/// Dear ImGui without a window: draws widgets frame by frame and uses them as a person would, by
/// moving a mouse to where they are and pressing keys. One at a time.
class Screen {
  public:
    /// `draw` is called once a frame, in a plain window of the panel's size.
    explicit Screen(std::function<void()> draw, float width = 1280, float height = 720);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    void frame(int count = 1);

    [[nodiscard]] std::optional<ui::NamedItem> find(const std::string& name) const;
    [[nodiscard]] bool shows(const std::string& name) const { return find(name).has_value(); }
    [[nodiscard]] bool enabled(const std::string& name) const;
    /// All names on the screen, for the message of a failed test.
    [[nodiscard]] std::string names() const;

    // Each returns false, and does nothing, where no such widget is on the screen.
    bool hover(const std::string& name);
    bool click(const std::string& name);
    bool doubleClick(const std::string& name);
    /// Presses the button at the widget's middle, moves the mouse, lets go.
    bool drag(const std::string& name, float dx, float dy);
    /// Clicks it with Ctrl, which makes a drag field a text field, and types a new value.
    bool typeInto(const std::string& name, const std::string& text);

    /// GLFW key codes.
    void press(int key, bool ctrl = false, bool shift = false);
    void type(const std::string& text);

  private:
    bool moveTo(const std::string& name);

    std::function<void()> draw_;
    ImGuiContext* context_ = nullptr;
};

}  // namespace dollytrack::test
