#include "ui/panels/export_pictures.h"

#include "ui/widgets/field_editor.h"
#include "ui/widgets/form.h"

#include <imgui.h>

#include <functional>

namespace dollytrack::ui {
namespace {

/// Calls visit(field, standard) for the fields that have a say in the mode.
void visitFieldsOfMode(PictureParams& params,
                       const std::function<void(const Field&, const Field&)>& visit) {
    PictureParams as_made;
    const FieldList standard = listPictureFields(as_made);
    const FieldList fields = listPictureFields(params);
    const std::string other =
        params.render_mode == RenderMode::Fast ? "antialias" : "reference_samples";
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i].name == "render_mode" || fields[i].name == other) {
            visit(fields[i], standard[i]);
        }
    }
}

}  // namespace

void drawPictureFields(PictureParams& params) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float half = (ImGui::GetContentRegionAvail().x - gap) / 2;
    visitFieldsOfMode(params, [&](const Field& field, const Field& standard) {
        if (field.name != "render_mode") ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(half);
        if (!drawFieldValue(field, standard, "export.picture." + field.name).says) {
            tooltip(std::string(field.text()));
        }
    });
}

std::vector<std::string> pictureSettings(PictureParams params) {
    std::vector<std::string> settings;
    visitFieldsOfMode(params, [&](const Field& field, const Field& standard) {
        if (field.valueText() == standard.valueText()) return;
        settings.push_back(field.name + "=" + field.valueText());
    });
    return settings;
}

}  // namespace dollytrack::ui
