#include "ui/widgets/files/file_browser.h"

#include "ui/theme.h"
#include "ui/widgets/files/file_list.h"
#include "ui/widgets/files/path_line.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/keyboard_wait.h"
#include "ui/widgets/message_box.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace dollytrack::ui {
namespace {

namespace fs = std::filesystem;
using Purpose = FileRequest::Purpose;

constexpr const char* kBrowserId = "##file_browser";

/// The purpose of a pending disk request.
enum class Intent { None, Enter, Accept };

}  // namespace

struct FileBrowser::Impl {
    explicit Impl(const std::function<void()>& wake)
        : reader(wake), sorter(wake), path_line(wake) {}

    void begin(FileRequest new_request);
    void collect();
    void receive(const PathAnswer& answer);
    void look(const fs::path& path, Intent why);
    void accept();
    void acceptPath(fs::path path);
    void rearrange();
    void selectByName(const std::string& name);
    [[nodiscard]] const FolderEntry* selectedEntry() const;

    void drawTop();
    void drawPlaces();
    void drawPlace(const std::string& label, const fs::path& folder, const std::string& name);
    void drawList(float height);
    [[nodiscard]] bool drawName();  // returns whether Enter was pressed
    [[nodiscard]] std::string missingEnding(const fs::path& path) const;
    [[nodiscard]] std::string noteText() const;
    void drawChoices();
    void drawButtons(bool entered);
    void drawNewFolder();
    void drawOverwrite();
    void drawContent();

    FileRequest request;
    bool open = false;
    bool begins = false;
    std::optional<FileAnswer> answer;

    FolderReader reader;
    FolderSorter sorter;
    Intent intent = Intent::None;
    fs::path folder;
    std::shared_ptr<const FolderListing> listing;
    std::shared_ptr<const FolderListing> sorted;  // the listing that `rows` refers to
    std::vector<std::uint32_t> rows;
    std::string problem;
    std::string select_name;  // entry to select when its folder has been read

    PathLine path_line;
    FolderOrder order;
    FolderOrder shown_order;
    FileListState list;
    int filter = 0;
    std::string name;
    bool focus_name = false;
    bool name_has_keys = false;
    bool awaits_keys = false;  // keyboard input is queued until the dialog's first field is ready
    fs::path overwrite;        // the existing file to confirm; empty: none
    std::string new_folder;
    bool making_folder = false;
};

void FileBrowser::Impl::begin(FileRequest new_request) {
    request = std::move(new_request);
    request.filters.push_back({"All files", {}});
    open = true;
    begins = true;
    focus_name = true;
    awaits_keys = true;
    answer.reset();
    filter = 0;
    name = request.name;
    problem.clear();
    overwrite.clear();
    listing.reset();
    sorted.reset();
    rows.clear();
    list = {};
    order.folders_only = request.purpose == Purpose::ChooseFolder;
    std::error_code error;
    if (request.start.empty()) request.start = fs::current_path(error);
    look(request.start, Intent::Enter);
}

void FileBrowser::Impl::look(const fs::path& path, Intent why) {
    intent = why;
    problem.clear();
    // Navigation falls back to the nearest existing folder; accepting needs the exact path.
    reader.look(path, why == Intent::Enter);
}

const FolderEntry* FileBrowser::Impl::selectedEntry() const {
    if (!sorted || list.selected < 0 || list.selected >= static_cast<int>(rows.size())) {
        return nullptr;
    }
    return &sorted->entries[rows[list.selected]];
}

void FileBrowser::Impl::selectByName(const std::string& wanted) {
    list.selected = -1;
    for (std::size_t row = 0; sorted && row < rows.size(); ++row) {
        if (sorted->entries[rows[row]].name != wanted) continue;
        list.selected = static_cast<int>(row);
        list.scroll = true;
    }
}

void FileBrowser::Impl::rearrange() {
    order.extensions = request.filters[filter].extensions;
    shown_order = order;
    if (listing) sorter.arrange(listing, order);
}

void FileBrowser::Impl::receive(const PathAnswer& found) {
    const Intent why = std::exchange(intent, Intent::None);
    if (!found.problem.empty()) {
        problem = found.problem;
        return;
    }
    const bool folder_found = found.found == PathAnswer::Found::Folder;
    const bool file_found = found.found == PathAnswer::Found::File;
    if (why == Intent::Accept && folder_found && request.purpose == Purpose::ChooseFolder) {
        answer = {request.id, found.path};
    } else if (folder_found) {
        folder = found.path;
        listing = found.listing;
        sorted.reset();
        rows.clear();
        list = {};
        path_line.show(folder / "");
        rearrange();
    } else if (file_found && why == Intent::Enter) {  // the initial path is a file
        select_name = found.path.filename().string();
        if (request.purpose == Purpose::Save) name = select_name;
        look(found.path.parent_path(), Intent::Enter);
    } else if (file_found && request.purpose == Purpose::Save) {
        overwrite = found.path;
    } else if (file_found && request.purpose == Purpose::ChooseFolder) {
        problem = "'" + found.path.filename().string() + "' is a file. Choose a folder.";
    } else if (file_found || (request.purpose == Purpose::Save && found.parent_is_folder)) {
        answer = {request.id, found.path};
    } else if (!found.parent_is_folder) {
        problem = "There is no folder " + found.path.parent_path().string() + ".";
    } else {
        problem = "There is no '" + found.path.filename().string() + "' in " +
                  found.path.parent_path().string() + ".";
    }
}

void FileBrowser::Impl::collect() {
    if (auto found = reader.take()) receive(*found);
    if (!(order == shown_order)) rearrange();
    if (auto done = sorter.take(); done && done->listing == listing) {
        const FolderEntry* entry = selectedEntry();
        std::string keep = entry != nullptr ? entry->name : std::string();
        if (!select_name.empty()) keep = std::exchange(select_name, {});
        sorted = std::move(done->listing);
        rows = std::move(done->rows);
        selectByName(keep);
    }
}

/// The extension to append to a name; empty if it has it.
std::string FileBrowser::Impl::missingEnding(const fs::path& path) const {
    return path.extension() == request.extension ? std::string() : request.extension;
}

void FileBrowser::Impl::acceptPath(fs::path path) {
    if (request.purpose == Purpose::Save && path.has_filename()) path += missingEnding(path);
    look(path, Intent::Accept);
}

void FileBrowser::Impl::accept() {
    if (request.purpose == Purpose::Save) {
        if (!name.empty()) acceptPath(typedPath(name, folder));
        return;
    }
    const FolderEntry* entry = selectedEntry();
    if (entry != nullptr) {
        look(folder / entry->name, Intent::Accept);
    } else if (request.purpose == Purpose::ChooseFolder) {
        look(folder, Intent::Accept);
    }
}

void FileBrowser::Impl::drawTop() {
    ImGui::PushFont(fonts().bold);
    ImGui::TextUnformatted(request.title.c_str());
    ImGui::PopFont();
    const bool at_root = folder.empty() || folder == folder.root_path();
    if (button("\u2191", "files.up",
               {.why_not = at_root ? "There is no parent folder." : "", .tip = "Parent folder"})) {
        select_name = folder.filename().string();
        look(folder.parent_path(), Intent::Enter);
    }
    ImGui::SameLine();
    const float buttons =
        ImGui::CalcTextSize("New folder").x + 2 * ImGui::GetStyle().FramePadding.x;
    if (path_line.draw(order, -(buttons + ImGui::GetStyle().ItemSpacing.x))) {
        const fs::path typed = typedPath(path_line.text(), folder);
        // A path with a trailing slash is a folder to enter, not an answer.
        if (!typed.has_filename()) {
            look(typed, Intent::Enter);
        } else {
            acceptPath(typed);
        }
    }
    ImGui::SameLine();
    if (button("New folder", "files.new_folder",
               {.why_not = listing ? "" : "The folder is still being read."})) {
        new_folder.clear();
        making_folder = true;
        ImGui::OpenPopup("new_folder");
    }
    drawNewFolder();
}

void FileBrowser::Impl::drawNewFolder() {
    if (!ImGui::BeginPopup("new_folder")) return;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(scaled(220));
    const bool entered = ImGui::InputTextWithHint("##name", "Name of the new folder", &new_folder,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    nameItem("files.new_folder_name");
    ImGui::SameLine();
    const bool usable = !new_folder.empty() && new_folder.find('/') == std::string::npos &&
                        new_folder != "." && new_folder != "..";
    const bool pressed =
        button("Make", "files.make_folder",
               {.why_not = usable ? "" : "Give a name without a slash.", .primary = true});
    if (usable && (entered || pressed)) {
        intent = Intent::Enter;
        problem.clear();
        reader.makeFolder(folder / new_folder);
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void FileBrowser::Impl::drawPlace(const std::string& label, const fs::path& place,
                                  const std::string& item) {
    ImGui::PushID(item.c_str());
    if (ImGui::Selectable(label.c_str(), place == folder)) look(place, Intent::Enter);
    ImGui::PopID();
    nameItem(item);
    tooltip(place.string());
}

void FileBrowser::Impl::drawPlaces() {
    std::error_code error;
    drawPlace("Home", homeFolder(), "files.place.home");
    drawPlace("Current folder", fs::current_path(error), "files.place.current");
    drawPlace("Computer", "/", "files.place.root");
    if (request.recent_folders.empty()) return;
    ImGui::Spacing();
    ImGui::TextColored(palette().text_dim, "Recent");
    for (std::size_t i = 0; i < request.recent_folders.size(); ++i) {
        const fs::path& recent = request.recent_folders[i];
        const std::string label =
            recent.filename().empty() ? recent.string() : recent.filename().string();
        drawPlace(label, recent, "files.recent." + std::to_string(i));
    }
}

void FileBrowser::Impl::drawList(float height) {
    ImGui::BeginChild("list", {0, height});
    const bool typing = ImGui::GetIO().WantTextInput || path_line.isTyping() || name_has_keys;
    const bool alone = overwrite.empty() && !ImGui::IsPopupOpen("new_folder");
    const FileListActions actions =
        drawFileList({sorted.get(), &rows, !typing && alone && !begins}, order, list);
    const FolderEntry* entry = selectedEntry();
    if (actions.selected && entry != nullptr) {
        problem.clear();
        if (!entry->is_folder && request.purpose == Purpose::Save) name = entry->name;
        path_line.show(entry->is_folder ? folder / "" : folder / entry->name);
    }
    if (!actions.path.empty()) path_line.typeOn(actions.path);
    if (actions.opened && entry != nullptr) {
        if (entry->is_folder) {
            look(folder / entry->name, Intent::Enter);
        } else {
            acceptPath(folder / entry->name);
        }
    }
    if (actions.go_up && folder != folder.root_path()) {
        select_name = folder.filename().string();
        look(folder.parent_path(), Intent::Enter);
    }
    ImGui::EndChild();
}

bool FileBrowser::Impl::drawName() {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Name");
    ImGui::SameLine();
    // Focus only after the folder is read: changes to the text of a focused field are lost.
    const bool there = listing || !problem.empty();
    if (there && std::exchange(focus_name, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    const bool entered = ImGui::InputText(
        "##name", &name, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    nameItem("files.name");
    name_has_keys = ImGui::IsItemActive();
    if (name_has_keys) awaits_keys = false;
    if (path_line.isTyping()) focus_name = false;
    return entered;
}

std::string FileBrowser::Impl::noteText() const {
    if (!problem.empty()) return problem;
    if (listing && !listing->problem.empty()) return listing->problem;
    if (request.purpose == Purpose::Save && !name.empty()) {
        const fs::path typed = typedPath(name, folder);
        if (typed.has_filename() && typed.has_extension() && !missingEnding(typed).empty()) {
            return "It will be saved as " + typed.filename().string() + request.extension +
                   ", because its name must end in " + request.extension + ".";
        }
    }
    if (!sorted) return "Reading the folder \u2026";
    if (sorted->entries.empty()) return "This folder is empty.";
    if (rows.empty()) return "No files of this type.";
    return std::to_string(rows.size()) + " of " + std::to_string(sorted->entries.size()) +
           " entries";
}

void FileBrowser::Impl::drawChoices() {
    if (request.purpose != Purpose::ChooseFolder) {
        ImGui::SetNextItemWidth(scaled(190));
        const std::string& chosen = request.filters[filter].name;
        if (ImGui::BeginCombo("##filter", chosen.c_str())) {
            for (int i = 0; i < static_cast<int>(request.filters.size()); ++i) {
                const FileFilter& choice = request.filters[i];
                if (ImGui::Selectable(choice.name.c_str(), i == filter)) {
                    filter = i;
                    rearrange();
                }
                nameItem("files.filter." + std::to_string(i));
            }
            ImGui::EndCombo();
        }
        nameItem("files.filter");
        ImGui::SameLine();
    }
    ImGui::Checkbox("Hidden", &order.hidden);
    nameItem("files.hidden");
    tooltip("Also show files whose names begin with a dot");
}

void FileBrowser::Impl::drawButtons(bool entered) {
    const float wide = scaled(90);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 2 * wide -
                    ImGui::GetStyle().ItemSpacing.x);
    if (button("Cancel", "files.cancel", {.width = wide})) open = false;
    ImGui::SameLine();
    std::string why_not;
    if (request.purpose == Purpose::Save && name.empty()) why_not = "Give a name first.";
    if (request.purpose == Purpose::Open && selectedEntry() == nullptr) {
        why_not = "Select a file first.";
    }
    const bool pressed = button(request.accept.c_str(), "files.accept",
                                {.why_not = why_not, .width = wide, .primary = true});
    if (pressed || (entered && why_not.empty())) accept();
}

void FileBrowser::Impl::drawOverwrite() {
    if (overwrite.empty()) return;
    const int pressed =
        drawMessageBox({false,
                        "Replace " + overwrite.filename().string() + "?",
                        "A file of that name exists. Replacing it deletes its content.",
                        {"Replace", "Cancel"}});
    if (pressed == 0) answer = {request.id, overwrite};
    if (pressed >= 0) overwrite.clear();
}

void FileBrowser::Impl::drawContent() {
    const bool asks =
        !overwrite.empty() || ImGui::IsPopupOpen("new_folder") || path_line.isTyping();
    if (!asks && !begins && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) open = false;
    drawTop();
    const std::string note = noteText();
    const bool wrong = !problem.empty() || (listing && !listing->problem.empty());
    const bool has_name = request.purpose == Purpose::Save;
    const float note_height =
        ImGui::CalcTextSize(note.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
    const float bottom = (has_name ? 2.0F : 1.0F) * ImGui::GetFrameHeightWithSpacing() +
                         note_height + ImGui::GetStyle().ItemSpacing.y + scaled(2);
    const float height = std::max(scaled(80), ImGui::GetContentRegionAvail().y - bottom);
    ImGui::BeginChild("places", {scaled(140), height});
    drawPlaces();
    ImGui::EndChild();
    ImGui::SameLine();
    drawList(height);
    const bool entered = has_name && drawName();
    if (sorted && !has_name) awaits_keys = false;
    if (!problem.empty() || path_line.isTyping()) awaits_keys = false;
    // Users may type before the dialog is ready; these keys are kept.
    if (awaits_keys) awaitKeyboard();
    paragraph(note, wrong ? palette().bad : palette().text_dim);
    drawChoices();
    drawButtons(entered);
    drawOverwrite();
}

FileBrowser::FileBrowser(std::function<void()> wake) : impl_(std::make_unique<Impl>(wake)) {}
FileBrowser::~FileBrowser() = default;

void FileBrowser::ask(FileRequest request) {
    impl_->begin(std::move(request));
}

bool FileBrowser::isOpen() const {
    return impl_->open;
}

std::optional<FileAnswer> FileBrowser::draw() {
    Impl& impl = *impl_;
    if (!impl.open) return std::nullopt;
    impl.collect();
    if (impl.begins) ImGui::OpenPopup(kBrowserId);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(scaled(900), screen.x - scaled(40)),
                              std::min(scaled(560), screen.y - scaled(40))});
    pushDialogStyle();
    const bool visible =
        ImGui::BeginPopupModal(kBrowserId, nullptr,
                               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings);
    popDialogStyle();
    if (visible) {
        impl.drawContent();
        impl.begins = false;
        if (impl.answer) impl.open = false;
        if (!impl.open) ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
    }
    return std::exchange(impl.answer, std::nullopt);
}

}  // namespace dollytrack::ui
