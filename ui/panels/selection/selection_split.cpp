#include "engine/core/field_list.h"
#include "engine/document/regroup.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/widgets/fields/field_editor.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>

namespace dollytrack::ui {
namespace {

FieldList fieldsOf(SplitLimits& limits) {
    FieldCollector fields;
    visitSplitLimits(limits, fields);
    return fields.take();
}

}  // namespace

nlohmann::json splitOperation(const nlohmann::json& object, const SplitLimits& limits) {
    nlohmann::json operation = {{"op", "split"}, {"object", object}};
    visitSplitLimits(limits, [&](const char* name, auto value, const FieldInfo&) {
        if (value != 0) operation[name] = value;
    });
    return operation;
}

std::string whyNoSplit(const SelectionView& view, const SplitLimits& limits) {
    if (view.piece_sizes_m == nullptr) return {};
    if (view.piece_sizes_m->size() < 2) return "It is one connected piece.";
    return keptPieces(*view.piece_sizes_m, limits) < 2
               ? "No two of its pieces are within the limits; lower the smallest size."
               : "";
}

std::string splitText(const SelectionView& view, const SplitLimits& limits) {
    if (view.piece_sizes_m == nullptr) return "Makes an object of every connected piece";
    const std::size_t kept = keptPieces(*view.piece_sizes_m, limits);
    if (kept < 2) return {};
    const std::size_t joined = view.piece_sizes_m->size() - kept;
    return fmt::format(
        "Makes {} objects of it, the smallest {:.3g} m{}", kept, (*view.piece_sizes_m)[kept - 1],
        joined == 0 ? "" : fmt::format("; {} smaller pieces join the nearest", joined));
}

void drawSplit(const SelectionView& view, SelectionState& state) {
    if (view.piece_sizes_m == nullptr || view.piece_sizes_m->size() < 2) return;
    heading(fmt::format("{} connected pieces, the smallest {:.3g} m", view.piece_sizes_m->size(),
                        view.piece_sizes_m->back())
                .c_str());
    if (!beginForm("split")) return;
    SplitLimits standard_limits;
    const FieldList fields = fieldsOf(state.split);
    const FieldList standard = fieldsOf(standard_limits);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        drawField(fields[i], standard[i], "selection.split." + fields[i].name);
    }
    const std::string why_not = whyNoSplit(view, state.split);
    formText("A split", why_not.empty() ? splitText(view, state.split) : why_not);
    endForm();
}

}  // namespace dollytrack::ui
