#include "app/cli/command_line.h"
#include "app/cli/scene_arguments.h"
#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>

namespace dollytrack::cli {

void addInfoCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand("info", "Say what a scene holds and what is doubtful");
    auto arguments = std::make_shared<SceneArguments>();
    addSceneArguments(*command, *arguments);
    command->callback([&session, arguments] {
        session.action = [&session, arguments]() -> Result<ExitCode> {
            const auto opened = openScene(*arguments, session.job());
            if (!opened) return tl::unexpected<Error>(opened.error());
            for (const Object& o : opened->scene->objects) {
                fmt::print("{:4} {:30} {:3} {} {:.2f} {:.2f} {:.2f} {}\n", o.id, o.name, o.nyu40,
                           o.role == Role::Target ? "target" : "structure", 2 * o.box.half_size.x(),
                           2 * o.box.half_size.y(), 2 * o.box.half_size.z(), o.large);
            }
            for (const auto& n : opened->scene->report.notes) fmt::print("{}\n", n);
            return kDone;
        };
    });
}

}  // namespace dollytrack::cli
