#include "app/cli/manual_settings.h"

#include "app/manual/man_page.h"
#include "app/version.h"
#include "engine/generate/room_spec.h"
#include "planning/baselines/planner.h"
#include "planning/plan_params.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"

#include <fmt/format.h>

namespace dollytrack::cli {
namespace {

enum class Takes { One, List };

template <class Rows>
manual::KnownValues namesOf(const Rows& rows, Takes takes) {
    manual::KnownValues known{{}, takes == Takes::List};
    for (const auto& row : rows) known.values.emplace_back(row.name);
    return known;
}

/// The names and "all", for an option that takes a list.
template <class Rows>
manual::KnownValues namesOrAll(const Rows& rows) {
    manual::KnownValues known = namesOf(rows, Takes::List);
    known.values.emplace_back("all");
    return known;
}

/// Assignments for completion: "loop=true" and "loop=false" for few values, "fill=" for numbers.
manual::KnownValues assignments(const FieldList& fields) {
    manual::KnownValues known;
    for (const Field& field : fields) {
        if (const auto* choice = std::get_if<Field::Choice>(&field.value)) {
            for (const std::string_view name : choice->info.names) {
                known.values.push_back(fmt::format("{}={}", field.name, name));
            }
        } else if (std::holds_alternative<Field::Switch>(field.value)) {
            known.values.push_back(field.name + "=true");
            known.values.push_back(field.name + "=false");
        } else {
            known.values.push_back(field.name + "=");
        }
    }
    return known;
}

std::string parameterEntries(const FieldList& fields) {
    std::string text = ".SH PARAMETERS\nEach parameter with its default, unit and range.\n";
    std::string section;
    for (const Field& field : fields) {
        if (field.section != section) text += ".SS " + field.section + "\n";
        section = field.section;
        const std::string_view unit = field.unit();
        text += fmt::format(".TP\n\\fB{}\\fR={}{}\n{} ({})\n", field.name,
                            manual::troffText(field.valueText()),
                            unit.empty() ? "" : " " + manual::troffText(std::string(unit)),
                            manual::troffText(std::string(field.text())),
                            manual::troffText(field.rangeAndConditionText()));
    }
    return text;
}

}  // namespace

manual::ManualSettings manualSettings() {
    planning::PlanParams params;
    const FieldList fields = planning::listFields(params);
    manual::ManualSettings settings;
    settings.version = versionText();
    settings.values = {
        {"--formats", namesOrAll(render::formats())},
        {"--modalities", namesOrAll(render::modalities())},
        {"--param", assignments(fields)},
        {"--planner", namesOf(planning::planners(), Takes::One)},
        {"--planners", namesOrAll(planning::planners())},
        {"--preset", namesOf(generate::roomPresets(), Takes::List)},
        {"--set", assignments(fields)},
        {"--up", {{"x", "y", "z", "-x", "-y", "-z"}, false}},
    };
    settings.more["params"] = parameterEntries(fields);
    settings.more[""] =
        ".SH FILES\n.TP\n.I dollytrack\\-import\nReads one scene file in a sandboxed process. The "
        "other programs start it; it must be in the same folder.\n"
        ".TP\n.I ~/.cache/dollytrack\nCache of scenes and computed light.\n"
        ".SH ENVIRONMENT\n.TP\n.B DOLLYTRACK_NO_CACHE\nIf 1, this cache is neither read nor "
        "written.\n";
    return settings;
}

}  // namespace dollytrack::cli
