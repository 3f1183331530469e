#include "ui/theme.h"

#include "engine/core/log.h"

#include <imgui_freetype.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

namespace dollytrack::ui {
namespace {

struct State {
    Fonts fonts;
    std::set<ImWchar> letters;       // beyond kRanges
    ImVector<ImWchar> glyph_ranges;  // ImGui reads them when it draws the atlas
    Palette palette;
    float scale = 1.0F;
};

State& state() {
    static State the_state;
    return the_state;
}

/// Ranges of the glyphs that are always loaded: Latin, Greek for the paper's symbols, punctuation,
/// arrows, mathematics, simple shapes.
constexpr std::array<ImWchar, 17> kRanges = {0x0020, 0x024F, 0x0370, 0x03FF, 0x2000, 0x206F,
                                             0x2070, 0x209F, 0x2190, 0x21FF, 0x2200, 0x22FF,
                                             0x2300, 0x23FF, 0x25A0, 0x27BF, 0};

void findGlyphRanges() {
    ImFontGlyphRangesBuilder builder;
    builder.AddRanges(kRanges.data());
    for (const ImWchar letter : state().letters) builder.AddChar(letter);
    state().glyph_ranges.clear();
    builder.BuildRanges(&state().glyph_ranges);
}

std::string findFont(std::initializer_list<const char*> candidates) {
    for (const char* name : candidates) {
        for (const char* root : {"/usr/share/fonts/", "/usr/local/share/fonts/"}) {
            std::error_code error;
            const std::filesystem::path path = std::filesystem::path(root) / name;
            if (std::filesystem::exists(path, error)) return path.string();
        }
    }
    return {};
}

/// A font with the glyphs of `file` and, for those that it lacks, of the others in their order.
ImFont* load(const std::string& file, std::initializer_list<std::string> others, float size) {
    ImGuiIO& io = ImGui::GetIO();
    const ImWchar* ranges = state().glyph_ranges.Data;
    if (file.empty()) {
        ImFontConfig config;
        config.SizePixels = size;
        return io.Fonts->AddFontDefault(&config);
    }
    ImFont* font = io.Fonts->AddFontFromFileTTF(file.c_str(), size, nullptr, ranges);
    for (const std::string& other : others) {
        if (other.empty()) continue;
        ImFontConfig merge;
        merge.MergeMode = true;
        io.Fonts->AddFontFromFileTTF(other.c_str(), size * 0.95F, &merge, ranges);
    }
    return font;
}

ImVec4 rgb(int hex, float alpha = 1.0F) {
    return {static_cast<float>((hex >> 16) & 255) / 255.0F,
            static_cast<float>((hex >> 8) & 255) / 255.0F, static_cast<float>(hex & 255) / 255.0F,
            alpha};
}

void setColors(ThemeKind kind) {
    const bool dark = kind == ThemeKind::Dark;
    dark ? ImGui::StyleColorsDark() : ImGui::StyleColorsLight();
    auto& colors = ImGui::GetStyle().Colors;
    const ImVec4 window = dark ? rgb(0x1E2126) : rgb(0xF6F6F4);
    const ImVec4 raised = dark ? rgb(0x2B2F36) : rgb(0xFFFFFF);
    const ImVec4 hover = dark ? rgb(0x3A4049) : rgb(0xE3E7EC);
    const ImVec4 pressed = dark ? rgb(0x4A515C) : rgb(0xD0D7DF);
    const ImVec4 accent = dark ? rgb(0x4C9AFF) : rgb(0x1C6DD0);
    const ImVec4 line = dark ? rgb(0x3A3F47) : rgb(0xD4D4D0);
    colors[ImGuiCol_Text] = dark ? rgb(0xE6E8EB) : rgb(0x1B1D20);
    colors[ImGuiCol_TextDisabled] = dark ? rgb(0x9198A3) : rgb(0x63686F);
    colors[ImGuiCol_WindowBg] = window;
    colors[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
    colors[ImGuiCol_PopupBg] = dark ? rgb(0x262A30, 0.98F) : rgb(0xFFFFFF, 0.98F);
    colors[ImGuiCol_Border] = line;
    colors[ImGuiCol_FrameBg] = raised;
    colors[ImGuiCol_FrameBgHovered] = hover;
    colors[ImGuiCol_FrameBgActive] = pressed;
    colors[ImGuiCol_TitleBg] = window;
    colors[ImGuiCol_TitleBgActive] = raised;
    colors[ImGuiCol_MenuBarBg] = dark ? rgb(0x17191D) : rgb(0xECECEA);
    colors[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
    colors[ImGuiCol_ScrollbarGrab] = dark ? rgb(0x4A515C) : rgb(0xB3B9C1);
    colors[ImGuiCol_ScrollbarGrabHovered] = dark ? rgb(0x5D6572) : rgb(0x969DA7);
    colors[ImGuiCol_ScrollbarGrabActive] = dark ? rgb(0x6E7785) : rgb(0x7C848F);
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = accent;
    colors[ImGuiCol_SliderGrabActive] = dark ? rgb(0x7DB5FF) : rgb(0x0F52A3);
    colors[ImGuiCol_Button] = raised;
    colors[ImGuiCol_ButtonHovered] = hover;
    colors[ImGuiCol_ButtonActive] = pressed;
    ImVec4 chosen = accent;
    chosen.w = dark ? 0.28F : 0.18F;
    colors[ImGuiCol_Header] = chosen;
    colors[ImGuiCol_HeaderHovered] = hover;
    colors[ImGuiCol_HeaderActive] = pressed;
    colors[ImGuiCol_Separator] = line;
    colors[ImGuiCol_Tab] = window;
    colors[ImGuiCol_TabHovered] = hover;
    colors[ImGuiCol_TabActive] = raised;
    colors[ImGuiCol_TabUnfocused] = window;
    colors[ImGuiCol_TabUnfocusedActive] = raised;
    // The text of a progress bar overlaps the bar; it must be readable on both colours.
    colors[ImGuiCol_PlotHistogram] = dark ? rgb(0x2D68B8) : rgb(0xA3CBF5);
    colors[ImGuiCol_PlotLines] = accent;
    colors[ImGuiCol_TextSelectedBg] = chosen;
    colors[ImGuiCol_NavHighlight] = accent;
    colors[ImGuiCol_TableHeaderBg] = raised;
    colors[ImGuiCol_TableBorderLight] = line;
    colors[ImGuiCol_TableBorderStrong] = line;
    colors[ImGuiCol_TableRowBgAlt] = dark ? ImVec4(1, 1, 1, 0.025F) : ImVec4(0, 0, 0, 0.025F);
    colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.45F);
    state().palette = {colors[ImGuiCol_TextDisabled],
                       dark ? rgb(0x66C283) : rgb(0x1E7F40),
                       dark ? rgb(0xF0B94D) : rgb(0x9A6200),
                       dark ? rgb(0xF2766B) : rgb(0xB8281C),
                       accent,
                       line};
}

}  // namespace

bool addLetters(std::string_view text) {
    constexpr std::size_t kMostLetters = 4000;  // more would not fit into the fonts' picture
    std::set<ImWchar>& letters = state().letters;
    const std::size_t before = letters.size();
    const char* const end = text.data() + text.size();
    for (const char* at = text.data(); at < end;) {
        unsigned int letter = 0;
        at += std::max(ImTextCharFromUtf8(&letter, at, end), 1);
        bool has = letter < kRanges[0] || letter > IM_UNICODE_CODEPOINT_MAX ||
                   letter == IM_UNICODE_CODEPOINT_INVALID;
        for (std::size_t i = 0; i + 1 < kRanges.size(); i += 2) {
            has = has || (letter >= kRanges[i] && letter <= kRanges[i + 1]);
        }
        if (!has && letters.size() < kMostLetters) letters.insert(static_cast<ImWchar>(letter));
    }
    return letters.size() > before;
}

void loadFonts(double scale) {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    findGlyphRanges();
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    const std::string symbols = findFont({"truetype/dejavu/DejaVuSans.ttf"});
    const std::string text =
        findFont({"opentype/inter/Inter-Regular.otf", "truetype/dejavu/DejaVuSans.ttf"});
    const std::string bold =
        findFont({"opentype/inter/Inter-SemiBold.otf", "truetype/dejavu/DejaVuSans-Bold.ttf"});
    const std::string mono = findFont({"truetype/dejavu/DejaVuSansMono.ttf"});
    std::string asian;
    if (!state().letters.empty()) {
        asian = findFont(
            {"truetype/droid/DroidSansFallbackFull.ttf", "opentype/noto/NotoSansCJK-Regular.ttc"});
    }
    if (text.empty()) {
        log::warn("editor",
                  "no font found; install fonts-inter or fonts-dejavu-core for readable text");
    }
    const auto size = static_cast<float>(15.0 * scale);
    state().fonts.text = load(text, {symbols, asian}, size);
    state().fonts.bold = load(bold, {symbols, asian}, size);
    state().fonts.mono = load(mono, {asian}, size * 0.93F);
    io.FontDefault = state().fonts.text;
}

const Fonts& fonts() {
    return state().fonts;
}

void applyTheme(ThemeKind kind, double scale) {
    state().scale = static_cast<float>(scale);
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    setColors(kind);
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 4};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {5, 3};
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    style.FrameRounding = 4;
    style.PopupRounding = 5;
    style.GrabRounding = 4;
    style.TabRounding = 4;
    style.ScrollbarRounding = 6;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = kind == ThemeKind::Light ? 1.0F : 0.0F;
    style.ScaleAllSizes(static_cast<float>(scale));
}

const Palette& palette() {
    return state().palette;
}

float scaled(float length) {
    return length * state().scale;
}

}  // namespace dollytrack::ui
