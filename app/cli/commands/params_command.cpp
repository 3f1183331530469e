#include "app/cli/command_line.h"
#include "planning/plan_params.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace dollytrack::cli {
namespace {

void printTable(const FieldList& fields) {
    std::string section;
    for (const Field& field : fields) {
        if (field.section != section) {
            section = field.section;
            fmt::print("{}\n", section);
        }
        const std::string symbol =
            field.symbol().empty() ? "" : fmt::format(" ({})", field.symbol());
        fmt::print("  {:<22} {:<8} {:<5} {}{}\n  {:<22} {}\n", field.name, field.valueText(),
                   field.unit(), field.text(), symbol, "", field.rangeAndConditionText());
    }
}

}  // namespace

void addParamsCommand(CLI::App& app, Session& session) {
    CLI::App* command =
        app.add_subcommand("params", "List the parameters that --set takes, with their defaults");
    auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print the defaults as JSON");
    command->callback([&session, as_json] {
        session.action = [as_json]() -> Result<ExitCode> {
            planning::PlanParams params;
            const FieldList fields = planning::listFields(params);
            if (*as_json) {
                fmt::print("{}\n", toJson(fields).dump(1));
            } else {
                printTable(fields);
            }
            return kDone;
        };
    });
}

}  // namespace dollytrack::cli
