#include "ui/widgets/cut_text.h"

#include "ui/widgets/form.h"

#include <vector>

namespace dollytrack::ui {
namespace {

constexpr std::string_view kDots = "\u2026";

float widthOf(std::string_view text) {
    return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

/// Byte offsets at which a text may be cut: before each UTF-8 character, and at the end.
std::vector<std::size_t> cutsOf(std::string_view text) {
    std::vector<std::size_t> cuts;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool goes_on = (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
        if (!goes_on) cuts.push_back(i);
    }
    cuts.push_back(text.size());
    return cuts;
}

/// The text shortened to `letters` characters.
std::string keep(std::string_view text, const std::vector<std::size_t>& cuts, std::size_t letters,
                 Cut cut) {
    // The beginning keeps three fifths: it says more than the end.
    const std::size_t behind = cut == Cut::Middle ? letters * 2 / 5 : 0;
    std::string kept(text.substr(0, cuts[letters - behind]));
    kept += kDots;
    kept += text.substr(cuts[cuts.size() - 1 - behind]);
    return kept;
}

float roomFor(float width) {
    return width > 0.0F ? width : ImGui::GetContentRegionAvail().x;
}

}  // namespace

std::string cutToWidth(std::string_view text, float width, Cut cut) {
    if (widthOf(text) <= width) return std::string(text);
    const std::vector<std::size_t> cuts = cutsOf(text);
    std::size_t fits = 0;
    std::size_t too_many = cuts.size() - 1;
    while (fits + 1 < too_many) {
        const std::size_t letters = (fits + too_many) / 2;
        (widthOf(keep(text, cuts, letters, cut)) <= width ? fits : too_many) = letters;
    }
    return keep(text, cuts, fits, cut);
}

void cutText(const std::string& text, const ImVec4& color, const std::string& tip, Cut cut,
             float width) {
    const float room = roomFor(width);
    ImGui::TextColored(color, "%s", cutToWidth(text, room, cut).c_str());
    wholeText(text, room, tip);
}

void wholeText(const std::string& text, float width, const std::string& tip) {
    const bool is_cut = widthOf(text) > roomFor(width);
    if (!is_cut) return tooltip(tip);
    tooltip(text + (tip.empty() ? "" : "\n" + tip));
}

}  // namespace dollytrack::ui
