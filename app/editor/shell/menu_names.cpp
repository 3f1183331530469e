#include "app/editor/shell/menu_names.h"

#include <string_view>
#include <utility>

namespace dollytrack::editor {

std::string withMenuNames(std::string message) {
    // Longer texts stand before texts that they contain.
    static constexpr std::pair<std::string_view, std::string_view> kNames[] = {
        {"leave out --keep-meshes", "uncheck File > Keep the file's meshes as objects"},
        {"leave --keep-meshes out", "uncheck File > Keep the file's meshes as objects"},
        {"pass --models ~/.gz/fuel", "add ~/.gz/fuel with File > Add a folder of models"},
        {"try --unit", "try File > Unit of length > Read the scene in another unit, m:"},
        {"try --up", "choose File > Upward axis:"},
        {"pass --up if", "choose another File > Upward axis if"},
        {"pass --up", "choose File > Upward axis:"},
        {"check --unit and --up", "check File > Unit of length and File > Upward axis"},
        {"--keep-meshes", "File > Keep the file's meshes as objects"},
        {"--labels", "File > Use a label file"},
        {"--models", "File > Add a folder of models"},
        {"--unit", "File > Unit of length"},
        {"--up", "File > Upward axis"},
        {"--set objective=surface", "the parameter objective: surface"},
        {"(Split into pieces in the editor, the operation split of 'dollytrack edit')",
         "with Split into pieces in the Selection panel"},
        {"(operation split of 'dollytrack edit')", "with Split into pieces in the Selection panel"},
        {"(dollytrack edit, set_class)", "in the Selection panel"},
        {"(dollytrack edit)", "in the Selection panel"},
    };
    for (const auto& [text, name] : kNames) {
        std::size_t at = 0;
        while ((at = message.find(text, at)) != std::string::npos) {
            message.replace(at, text.size(), name);
            at += name.size();
        }
    }
    return message;
}

}  // namespace dollytrack::editor
