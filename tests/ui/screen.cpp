#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <memory>

namespace dollytrack::test {
namespace {

/// Fonts take long to load, so all screens share them.
ImFontAtlas& atlas() {
    static const auto the_atlas = [] {
        auto fonts = std::make_unique<ImFontAtlas>();
        ImGuiContext* context = ImGui::CreateContext(fonts.get());
        ImGui::SetCurrentContext(context);
        ui::loadFonts(1.0);
        fonts->Build();
        ImGui::DestroyContext(context);
        return fonts;
    }();
    return *the_atlas;
}

/// The same keys as in the editor's window.
void setKeys(ImGuiIO& io) {
    const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                             {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                             {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                             {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                             {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                             {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                             {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                             {ImGuiKey_Home, GLFW_KEY_HOME},
                                             {ImGuiKey_End, GLFW_KEY_END},
                                             {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                             {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                             {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                             {ImGuiKey_Space, GLFW_KEY_SPACE},
                                             {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                             {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                             {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                             {ImGuiKey_A, GLFW_KEY_A},
                                             {ImGuiKey_C, GLFW_KEY_C},
                                             {ImGuiKey_V, GLFW_KEY_V},
                                             {ImGuiKey_X, GLFW_KEY_X},
                                             {ImGuiKey_Y, GLFW_KEY_Y},
                                             {ImGuiKey_Z, GLFW_KEY_Z}};
    for (const auto& [name, key] : keys) io.KeyMap[name] = key;
}

}  // namespace

Screen::Screen(std::function<void()> draw, float width, float height) : draw_(std::move(draw)) {
    context_ = ImGui::CreateContext(&atlas());
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    io.ConfigInputTextCursorBlink = false;
    io.FontDefault = ui::fonts().text;
    setKeys(io);
    ui::applyTheme(ui::ThemeKind::Dark, 1.0);
    ui::item_map::want(true);
    frame(2);
}

Screen::~Screen() {
    ui::item_map::want(false);
    ImGui::DestroyContext(context_);
}

void Screen::frame(int count) {
    for (int i = 0; i < count; ++i) {
        ImGui::GetIO().DeltaTime = 1.0F / 60.0F;
        ImGui::NewFrame();
        ui::item_map::beginFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
        ImGui::Begin("screen", nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
        draw_();
        ImGui::End();
        ui::item_map::endFrame();
        ImGui::Render();
    }
}

std::optional<ui::NamedItem> Screen::find(const std::string& name) const {
    const auto& items = ui::item_map::items();
    const auto at = std::ranges::find(items, name, &ui::NamedItem::name);
    return at == items.end() ? std::nullopt : std::optional(*at);
}

bool Screen::enabled(const std::string& name) const {
    const auto item = find(name);
    return item && item->enabled;
}

std::string Screen::names() const {
    std::string text;
    for (const ui::NamedItem& item : ui::item_map::items()) text += item.name + " ";
    return text;
}

bool Screen::moveTo(const std::string& name) {
    const auto item = find(name);
    if (!item) return false;
    ImGui::GetIO().MousePos = {(item->left + item->right) / 2, (item->top + item->bottom) / 2};
    return true;
}

bool Screen::hover(const std::string& name) {
    if (!moveTo(name)) return false;
    frame(2);
    return true;
}

bool Screen::click(const std::string& name) {
    if (!hover(name)) return false;
    ImGui::GetIO().MouseDown[0] = true;
    frame();
    ImGui::GetIO().MouseDown[0] = false;
    frame(2);
    // Long enough that the next click is not taken for the second one of a double click.
    frame(30);
    return true;
}

bool Screen::doubleClick(const std::string& name) {
    if (!hover(name)) return false;
    for (int i = 0; i < 2; ++i) {
        ImGui::GetIO().MouseDown[0] = true;
        frame();
        ImGui::GetIO().MouseDown[0] = false;
        frame();
    }
    frame(30);
    return true;
}

bool Screen::drag(const std::string& name, float dx, float dy) {
    if (!hover(name)) return false;
    ImGuiIO& io = ImGui::GetIO();
    io.MouseDown[0] = true;
    frame();
    for (int i = 0; i < 10; ++i) {
        io.MousePos.x += dx / 10;
        io.MousePos.y += dy / 10;
        frame();
    }
    io.MouseDown[0] = false;
    frame(30);
    return true;
}

bool Screen::typeInto(const std::string& name, const std::string& text) {
    if (!hover(name)) return false;
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = true;
    io.KeyMods = ImGuiKeyModFlags_Ctrl;
    io.MouseDown[0] = true;
    frame();
    io.MouseDown[0] = false;
    frame();
    io.KeyCtrl = false;
    io.KeyMods = 0;
    frame();
    press(GLFW_KEY_A, true);
    type(text);
    press(GLFW_KEY_ENTER);
    frame(30);
    return true;
}

void Screen::press(int key, bool ctrl, bool shift) {
    ImGuiIO& io = ImGui::GetIO();
    const auto modify = [&io](bool with_ctrl, bool with_shift) {
        io.KeyCtrl = with_ctrl;
        io.KeyShift = with_shift;
        io.KeyMods =
            (with_ctrl ? ImGuiKeyModFlags_Ctrl : 0) | (with_shift ? ImGuiKeyModFlags_Shift : 0);
    };
    modify(ctrl, shift);
    io.KeysDown[key] = true;
    frame();
    io.KeysDown[key] = false;
    modify(false, false);
    frame(2);
}

void Screen::type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frame(2);
}

}  // namespace dollytrack::test
