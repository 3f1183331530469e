#include "ui/widgets/fields/parameter_row.h"

#include "ui/widgets/fields/field_editor.h"

#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {

const Field* fieldNamed(const FieldList& fields, std::string_view name) {
    const auto found = std::ranges::find(fields, name, &Field::name);
    return found == fields.end() ? nullptr : &*found;
}

ParameterRowEdit drawParameterRow(const FieldList& fields, const FieldList& standard,
                                  std::initializer_list<std::string_view> names,
                                  const std::string& path) {
    ParameterRowEdit result;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const auto count = static_cast<float>(names.size());
    const float width = (ImGui::GetContentRegionAvail().x - (count - 1) * gap) / count;
    for (const std::string_view name : names) {
        const Field* field = fieldNamed(fields, name);
        const Field* usual = fieldNamed(standard, name);
        if (field == nullptr || usual == nullptr) continue;
        if (name != *names.begin()) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(width);
        const FieldEdit edit = drawFieldValue(*field, *usual, path + "." + field->name);
        result.finished = result.finished || edit.finished;
        if (edit.changed || edit.finished) result.name = field->name;
    }
    return result;
}

}  // namespace dollytrack::ui
