#include "ui/widgets/cut_lines.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace dollytrack::ui {
namespace {

constexpr unsigned kDots = 0x2026;
// A letter counts as cut if more than this of its width is missing, px.
constexpr float kMissing = 0.75F;
// A larger gap between two letters, in font sizes, separates lines.
constexpr float kLineGap = 1.2F;
// A gap from which on there is a space between two letters, in the same unit.
constexpr float kWordGap = 0.16F;

struct LetterBox {
    float left = 0, top = 0, right = 0, bottom = 0;
};

/// A letter as it is drawn.
struct Letter {
    LetterBox box;
    unsigned code = 0;
    float width = 0.0F;  // of the whole letter, px
};

/// Finds the letter of a quad by its place in the font texture, of which the quad may show a part.
class LetterTable {
  public:
    explicit LetterTable(const ImFontAtlas& atlas) {
        for (const ImFont* font : atlas.Fonts) {
            for (const ImFontGlyph& glyph : font->Glyphs) {
                if (glyph.Visible == 0) continue;
                by_left_.emplace(std::pair(glyph.U0, glyph.V0), &glyph);
                by_right_.emplace(std::pair(glyph.U1, glyph.V0), &glyph);
            }
        }
    }

    [[nodiscard]] std::optional<Letter> find(const LetterBox& box, const LetterBox& texture) const {
        const auto left = by_left_.find({texture.left, texture.top});
        const auto right = by_right_.find({texture.right, texture.top});
        const ImFontGlyph* glyph = left != by_left_.end()     ? left->second
                                   : right != by_right_.end() ? right->second
                                                              : nullptr;
        if (glyph == nullptr) return std::nullopt;
        const float share = (texture.right - texture.left) / (glyph->U1 - glyph->U0);
        return Letter{box, glyph->Codepoint, (box.right - box.left) / std::max(share, 1e-3F)};
    }

  private:
    std::map<std::pair<float, float>, const ImFontGlyph*> by_left_;
    std::map<std::pair<float, float>, const ImFontGlyph*> by_right_;
};

std::string letterText(unsigned code) {
    std::string text;
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0U | (code >> 6U));
        text += static_cast<char>(0x80U | (code & 0x3FU));
    } else {
        text += static_cast<char>(0xE0U | (code >> 12U));
        text += static_cast<char>(0x80U | ((code >> 6U) & 0x3FU));
        text += static_cast<char>(0x80U | (code & 0x3FU));
    }
    return text;
}

/// Collects letters into lines, and keeps the lines that are cut.
class LineCollector {
  public:
    void add(const Letter& letter, const ImVec4& clip) {
        const LetterBox& box = letter.box;
        if (box.bottom <= clip.y || box.top >= clip.w) return;  // scrolled out of sight
        if (box.right <= clip.x || box.left >= clip.z) return;
        const float height = ImGui::GetFontSize();
        const bool goes_on = !line_.text.empty() && box.left >= line_.right - 0.3F * height &&
                             box.left < line_.right + kLineGap * height &&
                             box.top < line_.bottom + 0.3F * height &&
                             box.bottom > line_.top - 0.3F * height;
        if (!goes_on) finish();
        const bool spaced = goes_on && box.left > line_.right + kWordGap * height;
        if (goes_on) {
            if (spaced) line_.text += ' ';
            line_.top = std::min(line_.top, box.top);
            line_.bottom = std::max(line_.bottom, box.bottom);
        } else {
            line_ = {{}, box.left, box.top, box.right, box.bottom};
        }
        const float left = std::max(box.left, clip.x);
        const float right = std::min(box.right, clip.z);
        cut_ = cut_ || right - left < letter.width - kMissing;
        cut_ = cut_ || (letter.code == kDots && goes_on && !spaced);
        line_.text += letterText(letter.code);
        line_.right = box.right;
    }

    void finish() {
        if (cut_) found_.push_back(line_);
        line_ = {};
        cut_ = false;
    }

    std::vector<CutLine> take() {
        finish();
        return std::move(found_);
    }

  private:
    CutLine line_;
    bool cut_ = false;
    std::vector<CutLine> found_;
};

struct CutRequest {
    bool waits = false;
    std::vector<CutLine> found;
};

CutRequest& cutRequest() {
    static CutRequest the_request;
    return the_request;
}

/// Adds the letters that a draw command draws as quads of the font's texture.
void addLetters(const ImDrawList& list, const ImDrawCmd& command, const LetterTable& table,
                LineCollector& lines) {
    for (unsigned i = 0; i + 6 <= command.ElemCount;) {
        const ImDrawIdx* index = &list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
        const bool quad = index[1] == index[0] + 1 && index[2] == index[0] + 2 &&
                          index[3] == index[0] && index[4] == index[2] && index[5] == index[0] + 3;
        if (!quad) {
            i += 3;
            continue;
        }
        i += 6;
        const ImDrawVert& low = list.VtxBuffer[static_cast<int>(command.VtxOffset + index[0])];
        const ImDrawVert& high = list.VtxBuffer[static_cast<int>(command.VtxOffset + index[2])];
        const auto letter = table.find({low.pos.x, low.pos.y, high.pos.x, high.pos.y},
                                       {low.uv.x, low.uv.y, high.uv.x, high.uv.y});
        if (letter) lines.add(*letter, command.ClipRect);
    }
}

}  // namespace

std::vector<CutLine> findCutLines(const ImDrawData& drawn) {
    const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const LetterTable table(atlas);
    LineCollector lines;
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const ImDrawList& list = *drawn.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback == nullptr && command.GetTexID() == atlas.TexID) {
                addLetters(list, command, table, lines);
            }
        }
        lines.finish();
    }
    return lines.take();
}

void requestCutLines() {
    cutRequest().waits = true;
}

void noteCutLines() {
    if (!std::exchange(cutRequest().waits, false)) return;
    const ImDrawData* drawn = ImGui::GetDrawData();
    cutRequest().found = drawn != nullptr ? findCutLines(*drawn) : std::vector<CutLine>();
}

const std::vector<CutLine>& cutLines() {
    return cutRequest().found;
}

}  // namespace dollytrack::ui
