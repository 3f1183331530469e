#include "ui/widgets/cut_text.h"

#include "ui/widgets/form.h"

#include <algorithm>
#include <cctype>
#include <map>
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

/// The number of bytes with which both texts begin; whole words, because parts of words and of
/// numbers mean nothing.
std::size_t sharedBytes(std::string_view a, std::string_view b, bool at_end) {
    const std::size_t most = std::min(a.size(), b.size());
    const auto at = [&](std::string_view text, std::size_t i) {
        return static_cast<unsigned char>(at_end ? text[text.size() - 1 - i] : text[i]);
    };
    std::size_t shared = 0;
    for (std::size_t i = 0; i < most && at(a, i) == at(b, i); ++i) {
        if (std::ispunct(at(a, i)) != 0 || at(a, i) == ' ') shared = i + 1;
    }
    return shared;
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

std::vector<std::string> cutApart(const std::vector<std::string>& texts, float width) {
    std::vector<std::string> shown;
    std::map<std::string, std::vector<std::size_t>> alike;  // indices by how they are cut
    for (std::size_t i = 0; i < texts.size(); ++i) {
        shown.push_back(cutToWidth(texts[i], width, Cut::Middle));
        if (shown[i] != texts[i]) alike[shown[i]].push_back(i);
    }
    for (const auto& [cut, group] : alike) {
        const std::string& first = texts[group.front()];
        std::size_t begin = first.size();
        std::size_t end = first.size();
        std::size_t shortest = first.size();
        for (const std::size_t i : group) {
            shortest = std::min(shortest, texts[i].size());
            if (texts[i] == first) continue;
            begin = std::min(begin, sharedBytes(first, texts[i], false));
            end = std::min(end, sharedBytes(first, texts[i], true));
        }
        if (begin == first.size()) continue;  // one text, or the same several times
        if (begin >= shortest) continue;      // nothing is left of the shortest
        if (begin + end >= shortest) end = 0;
        for (const std::size_t i : group) {
            const std::string own = texts[i].substr(begin, texts[i].size() - begin - end);
            shown[i] = cutToWidth(
                std::string(begin > 0 ? kDots : "") + own + std::string(end > 0 ? kDots : ""),
                width, Cut::Middle);
        }
    }
    return shown;
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
