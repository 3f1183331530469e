#include "app/cli/command_line.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/plan/planned_scene.h"
#include "app/cli/scene_arguments.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal/output_file.h"
#include "app/project/read_project.h"
#include "engine/document/edits_json.h"
#include "engine/document/operation.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/text_file.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/io/settings/project_file.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <sstream>

namespace dollytrack::cli {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct EditArguments {
    SceneArguments scene;
    std::string out;
    std::string script;
    std::string annotations;  // annotation file to write
    std::vector<std::string> operations;
    bool plan = false;
    bool list = false;
    bool dry_run = false;
    bool as_json = false;

    /// Whether the command only lists the existing edits.
    [[nodiscard]] bool showsOnly() const {
        return script.empty() && operations.empty() && annotations.empty();
    }
    [[nodiscard]] bool writesProject() const {
        return !out.empty() ||
               (!dry_run && isProjectFile(scene.path) && !(script.empty() && operations.empty()));
    }
};

/// Parses JSON. `code`: the error's code, BadInput for a file, Usage for an option's text.
Result<nlohmann::json> parse(const std::string& text, const std::string& where, ErrorCode code) {
    Result<nlohmann::json> json = parseBoundedJson(text, where);
    if (json) return json;
    const bool has_place = json.error().where != where;  // true if the text is not JSON at all
    return fail(code,
                has_place ? "This is not valid JSON; names and texts need double quotes, as in "
                            "{\"op\":\"exclude\",\"object\":\"lamp_3\"}."
                          : json.error().message,
                json.error().where);
}

/// The operations of the script, then those of --op.
Result<nlohmann::json> readOperations(const EditArguments& arguments) {
    nlohmann::json all = nlohmann::json::array();
    if (!arguments.script.empty()) {
        const Result<std::string> text = readText(arguments.script);
        if (!text) return tl::unexpected(text.error());
        Result<nlohmann::json> script = parse(*text, arguments.script, ErrorCode::BadInput);
        if (!script) return script;
        if (!script->is_array()) {
            return fail(ErrorCode::BadInput,
                        "A script is a list of operations: [{\"op\": ...}, ...].",
                        arguments.script);
        }
        all = std::move(*script);
    }
    for (const std::string& text : arguments.operations) {
        Result<nlohmann::json> one = parse(text, "--op", ErrorCode::Usage);
        if (!one) return one;
        all.push_back(std::move(*one));
    }
    return all;
}

void printOperations(bool as_json) {
    nlohmann::json list = nlohmann::json::array();
    for (const OperationInfo& info : listOperations()) {
        nlohmann::json fields = nlohmann::json::array();
        if (!as_json) fmt::print("{}\n  {}\n", info.op, info.text);
        for (const OperationField& field : info.fields) {
            fields.push_back({{"name", field.name},
                              {"kind", field.kind},
                              {"required", field.required},
                              {"text", field.text}});
            if (as_json) continue;
            fmt::print("    {:<16} {:<10} {}{}\n", field.name, field.kind,
                       field.required ? "" : "(optional) ", field.text);
        }
        list.push_back({{"op", info.op}, {"text", info.text}, {"fields", std::move(fields)}});
    }
    if (as_json) fmt::print("{}\n", jsonText(list));
}

/// One edit of a project for the list: kind, name and description.
struct EditRow {
    std::string kind;
    std::string name;
    std::string text;
};

std::string wordsOf(const std::vector<ObjectRef>& objects) {
    std::string text;
    for (const ObjectRef& object : objects) text += (text.empty() ? "" : ", ") + object.name;
    return text;
}

std::string wordsOf(const Eigen::Vector3d& point) {
    return fmt::format("{:.2f}, {:.2f}, {:.2f}", point.x(), point.y(), point.z());
}

std::string wordsOf(const SplitLimits& limits) {
    std::string text = "into its pieces";
    if (limits.min_size_m > 0.0) text += fmt::format(" from {:g} m up", limits.min_size_m);
    if (limits.max_pieces > 0) text += fmt::format(", {} at most", limits.max_pieces);
    return text;
}

std::string wordsOf(const ObjectChange& change) {
    std::vector<std::string> parts;
    if (change.role) parts.emplace_back(*change.role == Role::Target ? "target" : "excluded");
    if (change.nyu40) parts.push_back("class " + std::string(nyu40Name(*change.nyu40)));
    if (change.front) {
        parts.push_back(fmt::format("front {:.0f} deg",
                                    std::atan2(change.front->y(), change.front->x()) * kDegrees));
    }
    if (change.large) parts.emplace_back(*change.large ? "large" : "small");
    if (change.move && !change.move->offset_m.isZero(0.0)) {
        parts.push_back(fmt::format("moved by ({}) m", wordsOf(change.move->offset_m)));
    }
    if (!change.track.empty()) {
        parts.push_back(fmt::format("track of {} keys, {:g} to {:g} s", change.track.size(),
                                    change.track.front().time_s, change.track.back().time_s));
    }
    if (change.move && change.move->turn_rad != 0.0) {
        parts.push_back(fmt::format("turned by {:.1f} deg", change.move->turn_rad * kDegrees));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<EditRow> rowsOf(const Edits& edits) {
    std::vector<EditRow> rows;
    for (const ObjectDefinition& one : edits.scene.definitions) {
        const bool merged = one.kind == ObjectDefinition::Kind::Merge;
        rows.push_back({merged ? "merged" : "split", merged ? one.name : wordsOf(one.objects),
                        merged ? "from " + wordsOf(one.objects) : wordsOf(one.limits)});
    }
    for (const std::string& one : edits.scene.ignore) {
        rows.push_back({"ignored", one, "class or name that is not a target"});
    }
    for (const std::string& one : edits.scene.only) {
        rows.push_back({"only", one, "nothing else is a target"});
    }
    for (const ObjectChange& one : edits.scene.changes) {
        rows.push_back({"object", one.object.name, wordsOf(one)});
    }
    for (const PinnedPoint& one : edits.plan.pinned) {
        rows.push_back(
            {"pinned", one.name,
             fmt::format("at {} m, {}", wordsOf(one.pose.position),
                         one.objects.empty() ? "added" : "for " + wordsOf(one.objects))});
    }
    if (!edits.plan.start.empty()) {
        rows.push_back({"start", edits.plan.start, "the trajectory starts there"});
    }
    if (!edits.plan.end.empty()) {
        rows.push_back({"end", edits.plan.end, "the trajectory ends there"});
    }
    if (const SharedMotion& motion = edits.plan.motion) {
        const bool has_keys = !motion->keys.empty();
        rows.push_back({"motion", motion->name,
                        fmt::format("the trajectory, {} {} in {:.1f} s",
                                    has_keys ? motion->keys.size() : motion->frames.size(),
                                    has_keys ? "key frames" : "frames", motion->duration_s())});
    }
    for (const RemovedPoint& one : edits.plan.removed) {
        rows.push_back({"removed", wordsOf(one.objects), "gets no position point"});
    }
    for (const NoGoBox& one : edits.plan.no_go) {
        rows.push_back(
            {"no-go", one.name,
             fmt::format("at {} m, size {} m, turned {:.0f} deg", wordsOf(one.box.center),
                         wordsOf(Eigen::Vector3d(2.0 * one.box.half_size)),
                         one.box.yaw * kDegrees)});
    }
    for (const Region& one : edits.plan.regions) {
        rows.push_back(
            {"region", one.name,
             fmt::format("at {} m, size {} m, turned {:.0f} deg, weight {:g}{}",
                         wordsOf(one.box.center), wordsOf(Eigen::Vector3d(2.0 * one.box.half_size)),
                         one.box.yaw * kDegrees, one.weight,
                         one.must_see ? ", must be seen" : "")});
    }
    return rows;
}

/// Prints the manual edits, if no operation was given.
void printEdits(const Edits& edits, bool as_json) {
    if (as_json) {
        fmt::print("{}\n", jsonText(editsJson(edits)));
        return;
    }
    const std::vector<EditRow> rows = rowsOf(edits);
    if (rows.empty()) {
        fmt::print("There are no manual edits; 'dollytrack edit --list' lists the operations.\n");
        return;
    }
    std::size_t widest = 0;
    for (const EditRow& row : rows) widest = std::max(widest, row.name.size());
    for (const EditRow& row : rows) {
        fmt::print("{:<8} {:<{}}  {}\n", row.kind, row.name, std::min(widest, std::size_t{32}),
                   row.text);
    }
}

/// Checks the arguments of commands other than --list.
Status checkArguments(const EditArguments& arguments) {
    if (arguments.scene.path.empty()) {
        return fail(ErrorCode::Usage, "Give the project to edit, or a scene and -o.");
    }
    if (arguments.showsOnly() && (arguments.plan || arguments.dry_run || !arguments.out.empty())) {
        return fail(ErrorCode::Usage, "Give --script or --op; --list lists the operations.");
    }
    const SceneArguments& scene = arguments.scene;
    if (arguments.showsOnly() &&
        (scene.unit_m || scene.up_axis || scene.labels || !scene.models.empty() ||
         scene.annotations || scene.keep_meshes || scene.convert)) {
        return fail(ErrorCode::Usage,
                    "Edits are listed without reading the scene; leave --unit, --up, --labels, "
                    "--models, --annotations, --keep-meshes and --convert out.");
    }
    if (arguments.dry_run &&
        (arguments.plan || !arguments.out.empty() || !arguments.annotations.empty())) {
        return fail(ErrorCode::Usage,
                    "A dry run writes nothing; leave --plan, -o and --write-annotations out.");
    }
    if (arguments.out.empty() && !arguments.dry_run && !isProjectFile(arguments.scene.path) &&
        arguments.annotations.empty()) {
        return fail(ErrorCode::Usage, "A scene file is never changed; give a new project with -o.",
                    arguments.scene.path);
    }
    if (!arguments.out.empty() && !isProjectFile(arguments.out)) {
        return fail(ErrorCode::Usage, "A project's name must end in .dolly.", arguments.out);
    }
    return {};
}

/// Applies the operations and returns the names of the steps. If they change anything, the stored
/// plan is dropped.
Result<std::vector<std::string>> apply(const nlohmann::json& operations, OpenedScene& opened,
                                       const JobContext& job) {
    ProjectState state;
    state.parameters = toJson(planning::listFields(opened.params));
    state.edits = opened.edits;
    const ProjectState before = state;
    const planning::TargetParams& targets = opened.params.targets;
    Result<std::vector<std::string>> names =
        applyOperations(state, *opened.imported, planning::setParameter, operations,
                        {targets.small_volume_m3, targets.size_ratio}, job);
    if (!names || state == before) return names;
    opened.stored_result = nullptr;
    Status status =
        setFromJson(planning::listFields(opened.params), state.parameters).and_then([&] {
            return applyEdits(opened, std::move(state.edits));
        });
    if (!status) return tl::unexpected(std::move(status.error()));
    return names;
}

Result<ExitCode> runEdit(const EditArguments& arguments, const Session& session) {
    if (arguments.list) {
        printOperations(arguments.as_json);
        return kDone;
    }
    if (Status status = checkArguments(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (arguments.showsOnly()) {
        // Without reading the scene, which may be large or missing.
        const Result<ProjectContent> project = readProject(arguments.scene.path);
        if (!project) return tl::unexpected(project.error());
        printEdits(project->edits, arguments.as_json);
        return kDone;
    }
    const Result<nlohmann::json> operations = readOperations(arguments);
    if (!operations) return tl::unexpected(operations.error());
    const std::string out = arguments.out.empty() ? arguments.scene.path : arguments.out;
    for (const std::string& file :
         {arguments.writesProject() ? out : std::string(), arguments.annotations}) {
        if (Status status = checkWritable(file); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    const JobContext job = session.job();
    Result<OpenedScene> opened =
        openScene(arguments.scene, job.stage(0.0, arguments.plan ? 0.3 : 1.0, "loading"));
    if (!opened) return tl::unexpected(std::move(opened.error()));
    const Result<std::vector<std::string>> names = apply(*operations, *opened, job);
    if (!names) return tl::unexpected(names.error());
    nlohmann::json metrics;
    if (arguments.plan) {
        planning::Pipeline pipeline(opened->scene);
        Result<PlannedScene> planned =
            planScene(*opened, pipeline, job.stage(0.3, 1.0, "planning"));
        if (!planned) return tl::unexpected(std::move(planned.error()));
        opened->stored_result = std::move(planned->result);
        metrics = std::move(planned->metrics);
    }
    const ProjectFile project = projectOf(*opened);
    if (arguments.writesProject()) {
        if (Status status = saveProject(project, out); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    if (!arguments.annotations.empty()) {
        Status status = writeAnnotations(arguments.annotations, project.import, project.edits);
        if (!status) return tl::unexpected(std::move(status.error()));
    }
    if (arguments.as_json) {
        nlohmann::json summary = {{"operations", *names}};
        if (arguments.writesProject()) summary["out"] = out;
        if (!arguments.annotations.empty()) summary["annotations"] = arguments.annotations;
        if (arguments.plan) summary["metrics"] = std::move(metrics);
        fmt::print("{}\n", jsonText(summary));
        return kDone;
    }
    for (const std::string& name : *names) fmt::print("{}\n", name);
    if (arguments.plan) fmt::print("\n{}", metricsTable(metrics));
    return kDone;
}

}  // namespace

void addEditCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand("edit",
                                           "Edit a project manually: objects, points, no-go boxes, "
                                           "parameters; without --op or --script, list its edits");
    auto arguments = std::make_shared<EditArguments>();
    addSceneArguments(*command, arguments->scene);
    command->get_option("scene")->required(false);
    command
        ->add_option("--script", arguments->script,
                     "JSON list of operations; either all are applied or none")
        ->type_name("FILE.json");
    command
        ->add_option("--op", arguments->operations,
                     "One operation, applied after those of --script; repeatable")
        ->type_name("JSON")
        ->allow_extra_args(false);
    command
        ->add_option("-o,--out", arguments->out, "Write to this project instead of the edited one")
        ->type_name("FILE.dolly");
    command
        ->add_option("--write-annotations", arguments->annotations,
                     "Export the edits as annotations; SCENE.objects.json beside the scene is "
                     "found automatically")
        ->type_name("FILE");
    command->add_flag("--plan", arguments->plan, "Plan afterwards, and store the plan");
    command->add_flag("--dry-run", arguments->dry_run,
                      "Report the effect of the operations, such as the number of pieces of a "
                      "split, without writing");
    command->add_flag("--list", arguments->list, "List all operations with their fields");
    command->add_flag("--json", arguments->as_json, "Print as JSON");
    command->footer(
        "Operations on camera keys: add_camera_key, change_camera_key, remove_camera_key;\n"
        "set_motion replaces all keys. object_track sets the keys of a moving object. The\n"
        "guide on planning ('Files of key frames') has an example; 'repair --keys' reads\n"
        "TUM, KITTI and other trajectory files.\n"
        "Example: dollytrack edit room.dolly --op '{\"op\":\"exclude\",\"object\":\"lamp_3\"}' "
        "--plan");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runEdit(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
