#include "ui/widgets/files/path_line.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/keyboard_wait.h"
#include "ui/widgets/text_match.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

namespace dollytrack::ui {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOffers = 8;

/// Splits "/home/a/ro" into "/home/a/" and "ro".
std::pair<std::string, std::string> splitTyped(const std::string& text) {
    const std::size_t slash = text.rfind('/');
    if (slash == std::string::npos) return {"", text};
    return {text.substr(0, slash + 1), text.substr(slash + 1)};
}

std::string commonStart(const std::vector<std::string>& texts) {
    std::string common = texts.front();
    for (const std::string& text : texts) {
        const auto [end, other] =
            std::mismatch(common.begin(), common.end(), text.begin(), text.end());
        common.erase(end, common.end());
    }
    return common;
}

}  // namespace

fs::path homeFolder() {
    const char* home = std::getenv("HOME");
    return home != nullptr && *home == '/' ? fs::path(home) : fs::path("/");
}

fs::path typedPath(const std::string& text, const fs::path& folder) {
    if (text == "~") return homeFolder();
    if (text.starts_with("~/")) return (homeFolder() / text.substr(2)).lexically_normal();
    return (folder / text).lexically_normal();
}

void PathLine::show(const fs::path& path) {
    if (typing_ || takes_over_) return;
    text_ = path.string();
}

void PathLine::typeOn(const std::string& begun) {
    text_ = begun;
    wants_focus_ = true;
    takes_over_ = true;
    awaitKeyboard();
}

void PathLine::moveChoice(int rows) {
    suggestions_hidden_ = false;
    if (offers_.empty() || offered_for_ != text_) return;  // the list opens with the next frame
    // The positions are those of the offers, and one for the typed text itself.
    const int positions = static_cast<int>(offers_.size()) + 1;
    chosen_ = (chosen_ + 1 + rows + positions) % positions - 1;
}

std::string PathLine::takeChosen() {
    const int chosen = std::exchange(chosen_, -1);
    return isListOpen() && chosen >= 0 && chosen < static_cast<int>(offers_.size())
               ? offers_[static_cast<std::size_t>(chosen)]
               : std::string();
}

void PathLine::complete(std::string& text) const {
    if (offers_.empty()) return;
    if (chosen_ >= 0) {
        text = offers_[static_cast<std::size_t>(chosen_)];
        return;
    }
    const std::string common = commonStart(offers_);
    text = common.size() > text.size() ? common : offers_.front();
}

void PathLine::updateOffers(const FolderOrder& order) {
    while (auto answer = reader_.take()) {
        listing_ = answer->listing;
        offered_for_.clear();
    }
    const auto [folder, part] = splitTyped(text_);
    if (folder.empty()) {
        offers_.clear();
        chosen_ = -1;
        return;
    }
    if (folder != asked_folder_) {
        asked_folder_ = folder;
        listing_ = nullptr;
        offers_.clear();
        chosen_ = -1;
        reader_.look(typedPath(folder, "/"));
    }
    if (!listing_ || offered_for_ == text_) return;
    offered_for_ = text_;
    offers_.clear();
    chosen_ = -1;
    FolderOrder shown = order;
    shown.hidden = shown.hidden || part.starts_with('.');
    FolderListing matching;
    for (const FolderEntry& entry : listing_->entries) {
        if (beginsWithIgnoringCase(entry.name, part)) matching.entries.push_back(entry);
    }
    for (const std::uint32_t row : arrange(matching, shown)) {
        if (offers_.size() == kMostOffers) break;
        const FolderEntry& entry = matching.entries[row];
        offers_.push_back(folder + entry.name + (entry.is_folder ? "/" : ""));
    }
}

bool PathLine::drawOffers(float left, float top, float width) {
    std::string taken;
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const float height = row * static_cast<float>(offers_.size()) + scaled(12);
    ImGui::SetNextWindowPos({left, top});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(7), scaled(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin("##path_offers", nullptr,
                 ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    for (std::size_t i = 0; i < offers_.size(); ++i) {
        const std::string& offer = offers_[i];
        const std::string name =
            splitTyped(offer.substr(0, offer.size() - 1)).second + offer.back();
        ImGui::Selectable(name.c_str(), static_cast<int>(i) == chosen_);
        nameItem("files.offer." + name);
        // IsItemHovered() would be false here, because the active text field captures the mouse.
        if (ImGui::IsMouseHoveringRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()) &&
            ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
            taken = offer;
        }
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    if (!taken.empty()) take(taken);
    return !taken.empty();
}

bool PathLine::drawField(float width) {
    const auto on_event = [](ImGuiInputTextCallbackData* data) {
        auto* line = static_cast<PathLine*>(data->UserData);
        if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory) {
            line->moveChoice(data->EventKey == ImGuiKey_UpArrow ? -1 : 1);
            return 0;
        }
        if (data->EventFlag == ImGuiInputTextFlags_CallbackAlways) {
            if (!std::exchange(line->to_end_, false)) return 0;
            data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
            return 0;
        }
        std::string text(data->Buf, static_cast<std::size_t>(data->BufTextLen));
        line->complete(text);
        data->DeleteChars(0, data->BufTextLen);
        data->InsertChars(0, text.c_str());
        return 0;
    };
    const bool closes_list = typing_ && isListOpen() && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false);
    const std::string typed = text_;
    ImGui::SetNextItemWidth(width);
    const bool entered = ImGui::InputText(
        "##path", &text_,
        ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackAlways |
            ImGuiInputTextFlags_CallbackHistory | ImGuiInputTextFlags_EnterReturnsTrue,
        on_event, this);
    if (closes_list) {
        // The field has undone what was typed and lost the keyboard, but this Esc is for the list.
        text_ = typed;
        continueTyping();
    }
    return entered;
}

bool PathLine::draw(const FolderOrder& order, float width) {
    if (wants_focus_) {
        ImGui::SetKeyboardFocusHere();
        wants_focus_ = false;
    }
    if (takes_over_) {
        awaitKeyboard();
        // Keyboard focus moves one frame later; letters typed meanwhile are kept.
        ImGuiIO& io = ImGui::GetIO();
        for (const ImWchar c : io.InputQueueCharacters) {
            if (c >= 32 && c < 127) text_ += static_cast<char>(c);
        }
        io.InputQueueCharacters.resize(0);
        to_end_ = true;  // focusing selects all text; the next letter would replace it
    }
    const std::string before = text_;
    const bool was_typing = typing_;
    const bool entered = drawField(width);
    nameItem("files.path");
    typing_ = ImGui::IsItemActive();
    if (text_ != before) suggestions_hidden_ = false;
    if (ImGui::IsItemActivated()) {
        // Suggestions appear with the first letter.
        suggestions_hidden_ = !takes_over_ || stays_closed_;
        takes_over_ = stays_closed_ = false;
    }
    if (entered) {
        typing_ = false;
        const std::string chosen = takeChosen();
        if (!chosen.empty()) take(chosen);
        return true;
    }
    // Clicking a suggestion takes the keyboard from the field, but must still be handled below.
    if (!(typing_ || was_typing) || suggestions_hidden_ || stays_closed_) return false;
    updateOffers(order);
    if (offers_.empty()) return false;
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    return drawOffers(low.x, high.y + scaled(2), high.x - low.x);
}

void PathLine::take(const std::string& offer) {
    text_ = offer;
    typing_ = false;
    if (offer.ends_with('/')) continueTyping();  // the next part of the path
}

void PathLine::continueTyping() {
    wants_focus_ = takes_over_ = stays_closed_ = true;
    chosen_ = -1;
    awaitKeyboard();
}

}  // namespace dollytrack::ui
