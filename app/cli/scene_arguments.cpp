#include "app/cli/scene_arguments.h"

#include "app/process/scene_conversion.h"
#include "app/project/read_project.h"
#include "engine/core/field_list.h"
#include "engine/core/fold_repeats.h"
#include "engine/core/log.h"
#include "engine/core/name_hint.h"
#include "engine/core/text_lists.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/document/edits_json.h"
#include "engine/document/operation.h"
#include "engine/document/target_filter.h"
#include "engine/scene/labels.h"
#include "engine/scene/object_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <functional>

namespace dollytrack::cli {
namespace {

Status applyArguments(const SceneArguments& arguments, planning::PlanParams& params) {
    const FieldList fields = planning::listFields(params);
    std::vector<std::string> all = arguments.assignments;
    if (arguments.seed) all.push_back(fmt::format("seed={}", *arguments.seed));
    if (arguments.max_frames) all.push_back(fmt::format("max_frames={}", *arguments.max_frames));
    if (arguments.max_length_m) {
        all.push_back(fmt::format("max_length_m={}", *arguments.max_length_m));
    }
    if (arguments.fps) {
        all.push_back(fmt::format("frame_rate={}", *arguments.fps));
        all.emplace_back("keep_frame_rate=true");
    }
    if (arguments.duration_s) all.push_back(fmt::format("duration_s={}", *arguments.duration_s));
    if (arguments.loop) all.emplace_back("loop=true");
    // The order of files: presets come before the fields that they set.
    std::ranges::stable_sort(all, std::less(), [&](const std::string& assignment) {
        return std::ranges::find(fields, assignment.substr(0, assignment.find('=')), &Field::name) -
               fields.begin();
    });
    for (const std::string& assignment : all) {
        if (Status status = setField(fields, assignment); !status) return status;
    }
    return {};
}

/// Warns of each given planning parameter that has no effect because of another parameter's value.
/// Parameters of images are checked by the export.
void warnOfArgumentsWithoutEffect(const SceneArguments& arguments, planning::PlanParams params) {
    const FieldList fields = planning::listFields(params);
    for (const std::string& assignment : arguments.assignments) {
        const std::string name = assignment.substr(0, assignment.find('='));
        const auto field = std::ranges::find(fields, name, &Field::name);
        if (field == fields.end() || planning::affectsOnlyImages(field->section)) continue;
        const std::string message = noEffectMessage(fields, *field);
        if (!message.empty()) log::warn("plan", message);
    }
}

/// The operation for --start or --end: "bed" names a pinned point, "1,2,1.5,0,0,1" is a position
/// and a target.
Result<nlohmann::json> endOperation(const std::string& option, const std::string& text) {
    nlohmann::json operation = {{"op", option == "--start" ? "set_start" : "set_end"}};
    std::vector<double> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (at != end) {
        // strtod() depends on the locale.
        while (at != end && (*at == ' ' || *at == '+')) ++at;
        double number = 0.0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || (after != end && *after != ',')) break;
        numbers.push_back(number);
        at = after != end && after + 1 != end ? after + 1 : after;
    }
    if (at != end || text.empty()) {
        operation["point"] = text;
        return operation;
    }
    if (numbers.size() != 6) {
        return fail(ErrorCode::Usage,
                    "Give six numbers, x,y,z of the camera and of the point it looks at, or the "
                    "name of a pinned point.",
                    option);
    }
    operation["position"] = {numbers[0], numbers[1], numbers[2]};
    operation["target"] = {numbers[3], numbers[4], numbers[5]};
    return operation;
}

/// Refuses patterns that match no object, probably typing errors. A known class may be missing from
/// the scene for --ignore, and for --only if another pattern matches.
Status checkPatterns(const SceneArguments& arguments, const Scene& scene) {
    const auto isAny = [&](const std::string& pattern) {
        return std::ranges::any_of(
            scene.objects, [&](const Object& object) { return isNamedBy(object, pattern); });
    };
    const bool only_names_some = std::ranges::any_of(arguments.only, isAny);
    std::vector<std::string> names;
    for (const Object& object : scene.objects) names.push_back(object.name);
    for (int i = 1; i <= kNyu40Count; ++i) {
        if (std::string name(nyu40Name(i)); isAny(name)) names.push_back(std::move(name));
    }
    for (const DatasetClass& one : scene.classes().classes()) {
        if (scene.class_table && isAny(one.name)) names.push_back(one.name);
    }
    for (const auto& [option, patterns, may_lack_class] :
         {std::tuple("--ignore", &arguments.ignore, true),
          std::tuple("--only", &arguments.only, only_names_some)}) {
        for (const std::string& pattern : *patterns) {
            if (isAny(pattern) || (may_lack_class && isClassName(scene, pattern))) continue;
            return fail(ErrorCode::Usage,
                        fmt::format("'{}' is neither a class nor an object of this scene{}",
                                    pattern, nameHint(pattern, names)),
                        option);
        }
    }
    return {};
}

/// Refuses --only and --ignore lists that together leave no target. A scene without targets, or
/// `--ignore '*'` alone, is accepted.
Status checkSomeAreLeft(const SceneArguments& arguments, const SceneEdits& edits,
                        const Scene& imported) {
    if (arguments.only.empty() || edits.ignore.empty()) return {};
    const auto hasTargets = [&](const SceneEdits& with) {
        const Result<Scene> edited = applySceneEdits(imported, with);
        return !edited || std::ranges::any_of(edited->objects, [](const Object& object) {
            return object.role == Role::Target;
        });
    };
    SceneEdits without = edits;
    without.ignore.clear();
    if (hasTargets(edits) || !hasTargets(without)) return {};
    return fail(
        ErrorCode::Usage,
        "No target is left, because --ignore excludes everything in --only; change one of the two.",
        "--ignore");
}

void addNew(std::vector<std::string>& list, const std::vector<std::string>& more) {
    for (const std::string& one : more) {
        if (std::find(list.begin(), list.end(), one) == list.end()) list.push_back(one);
    }
}

/// The project's edits, extended by the command line.
Result<Edits> withArguments(Edits edits, const SceneArguments& arguments, const Scene& imported) {
    ProjectState state{.edits = std::move(edits)};
    if (!arguments.one_of_several && !(arguments.ignore.empty() && arguments.only.empty())) {
        const Result<Scene> edited = applySceneEdits(imported, state.edits.scene);
        if (!edited) return tl::unexpected(edited.error());
        if (Status status = checkPatterns(arguments, *edited); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    addNew(state.edits.scene.ignore, arguments.ignore);
    addNew(state.edits.scene.only, arguments.only);
    if (!arguments.one_of_several) {
        if (Status status = checkSomeAreLeft(arguments, state.edits.scene, imported); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    for (const auto& [option, text] :
         {std::pair("--start", &arguments.start), std::pair("--end", &arguments.end)}) {
        if (text->empty()) continue;
        const Result<nlohmann::json> operation = endOperation(option, *text);
        if (!operation) return tl::unexpected(operation.error());
        const Result<std::string> done =
            applyOperation(state, {imported, planning::setParameter}, *operation);
        if (!done) return fail(ErrorCode::Usage, done.error().message, option);
    }
    if (arguments.time_s) {
        const Result<std::string> done =
            applyOperation(state, {imported, planning::setParameter},
                           {{"op", "at_time"}, {"time_s", *arguments.time_s}});
        if (!done) return fail(ErrorCode::Usage, done.error().message, "--time");
    }
    return std::move(state.edits);
}

/// Validates --cloud settings and stores those that were given.
Status addCloudSettings(const SceneArguments& arguments, nlohmann::json& stored) {
    for (const std::string& assignment : arguments.cloud) {
        CloudParams params;
        FieldCollector fields;
        visitCloudParams(params, fields);
        const FieldList list = fields.take();
        if (Status status = setField(list, assignment); !status) return status;
        const std::string name = assignment.substr(0, assignment.find('='));
        stored["cloud"][name] = toJson(list)["cloud"][name];
    }
    return {};
}

/// The project's import settings, overridden by the command line.
nlohmann::json importSettings(const SceneArguments& arguments, nlohmann::json stored) {
    if (arguments.unit_m) stored["unit_m"] = *arguments.unit_m;
    if (arguments.up_axis) stored["up_axis"] = *arguments.up_axis;
    if (arguments.labels) stored["labels"] = std::filesystem::absolute(*arguments.labels).string();
    if (!arguments.models.empty()) {
        stored["model_folders"] = nlohmann::json::array();
        for (const std::string& folder : arguments.models) {
            stored["model_folders"].push_back(std::filesystem::absolute(folder).string());
        }
    }
    if (arguments.annotations) {
        stored["annotations"] = std::filesystem::absolute(*arguments.annotations).string();
    }
    if (arguments.keep_meshes) stored["regroup"] = false;
    return stored;
}

void warnOfAll(std::string_view subsystem, const std::vector<std::string>& warnings) {
    for (const std::string& one : foldRepeats(warnings)) log::warn(subsystem, one);
}

void warnOfTextures(const ImportReport& report) {
    const std::vector<std::string>& missing = report.textures_missing;
    if (missing.empty()) return;
    constexpr std::size_t kShown = 3;
    log::warn("import",
              counted(missing.size(), "texture was", "textures were") +
                  " not found in the scene's folder and its subfolders, so surfaces have flat "
                  "colours; copy them there: " +
                  listOf(missing, kShown));
}

/// The planning parameters that differ, by name, with their values in `other`.
std::vector<std::pair<std::string, std::string>> changedValues(const planning::PlanParams& one,
                                                               const planning::PlanParams& other) {
    return planning::changedFields(planning::onlyOfThePlan(one), planning::onlyOfThePlan(other));
}

/// How to plan with changed parameters at once, as the end of a message.
std::string planningOnceText(const planning::PlanParams& planned,
                             const planning::PlanParams& changed) {
    std::string options;
    for (const auto& [name, value] : changedValues(planned, changed)) {
        // Shells take some characters for their own.
        const bool quoted = std::ranges::any_of(value, [](unsigned char c) {
            return std::isalnum(c) == 0 &&
                   std::string_view("_.,:/+-").find(static_cast<char>(c)) == std::string_view::npos;
        });
        options += fmt::format("--set {0}{1}={2}{0} ", quoted ? "'" : "", name, value);
    }
    return fmt::format("; to plan only once, give {}to 'dollytrack plan'", options);
}

}  // namespace

std::string changedNames(const planning::PlanParams& one, const planning::PlanParams& other) {
    std::string names;
    for (const auto& [name, value] : changedValues(one, other)) {
        names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

Status applyEdits(OpenedScene& opened, Edits edits) {
    opened.edits = std::move(edits);
    opened.scene = opened.imported;
    if (opened.edits.scene != SceneEdits{}) {
        const planning::TargetParams& targets = opened.params.targets;
        Result<Scene> edited = applySceneEdits(*opened.imported, opened.edits.scene,
                                               {targets.small_volume_m3, targets.size_ratio});
        if (!edited) return tl::unexpected(std::move(edited.error()));
        opened.scene = std::make_shared<const Scene>(std::move(*edited));
        // Warnings of the import were already printed.
        const auto& all = opened.scene->report.warnings;
        const auto said = static_cast<std::ptrdiff_t>(opened.imported->report.warnings.size());
        warnOfAll("edits", {all.begin() + said, all.end()});
    }
    std::vector<std::string> lost;
    opened.plan_edits = findObjects(opened.edits.plan, *opened.scene, lost);
    warnOfAll("edits", lost);
    return {};
}

namespace {

/// Applies the edits together with those of the arguments.
Status applyEditsAndArguments(OpenedScene& opened, const Edits& given,
                              const SceneArguments& arguments) {
    Result<Edits> edits = withArguments(given, arguments, *opened.imported);
    if (!edits) return tl::unexpected(std::move(edits.error()));
    if (!arguments.start.empty()) opened.asked_start = edits->plan.start;
    if (!arguments.end.empty()) opened.asked_end = edits->plan.end;
    return applyEdits(opened, std::move(*edits));
}

}  // namespace

Result<OpenedScene> openedWith(OpenedScene opened, const SceneArguments& arguments) {
    const planning::TargetParams before = opened.params.targets;
    if (Status status = applyArguments(arguments, opened.params); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const planning::TargetParams& targets = opened.params.targets;
    if (targets.small_volume_m3 != before.small_volume_m3 ||
        targets.size_ratio != before.size_ratio) {
        Scene sorted = *opened.imported;
        sortBySize(sorted.objects, targets.small_volume_m3, targets.size_ratio);
        opened.imported = std::make_shared<const Scene>(std::move(sorted));
    }
    opened.stored_result = nullptr;
    warnOfArgumentsWithoutEffect(arguments, opened.params);
    if (Status status = applyEditsAndArguments(opened, opened.edits, arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    return opened;
}

std::string noEffectMessage(const FieldList& fields, const Field& field) {
    const std::string because = withoutEffectBy(fields, field);
    if (because.empty()) return {};
    std::string needed(field.onlyWith());
    const std::size_t above = needed.find('>');
    if (above != std::string::npos) needed.replace(above, 1, " above ");
    for (std::size_t bar = needed.find('|'); bar != std::string::npos; bar = needed.find('|')) {
        needed.replace(bar, 1, " or ");
    }
    return fmt::format("{} has no effect with {}; set {}", field.name, because, needed);
}

ProjectFile projectOf(const OpenedScene& opened) {
    ProjectFile project;
    project.scene = opened.imported->source;
    project.scene_sha256 = opened.imported->source_sha256;
    project.import = opened.import;
    planning::PlanParams params = opened.params;
    project.parameters = toJson(planning::listFields(params));
    project.edits = editsJson(opened.edits, opened.edits_section);
    project.result = opened.stored_result;
    project.others = opened.project_others;
    return project;
}

Status checkArguments(const SceneArguments& arguments) {
    if (arguments.convert && isBlenderFile(arguments.path)) {
        ProjectContent standard;  // the scene itself is checked after the conversion
        return applyArguments(arguments, standard.params);
    }
    Result<ProjectContent> read = readProject(arguments.path, arguments.annotations);
    if (!read) return tl::unexpected(std::move(read.error()));
    if (Status status = applyArguments(arguments, read->params); !status) return status;
    return checkScene(*read);
}

Result<OpenedScene> openScene(const SceneArguments& arguments, const JobContext& job) {
    Result<std::filesystem::path> path = arguments.path;
    JobContext reading = job;
    if (arguments.convert && isBlenderFile(arguments.path)) {
        path = convertScene(arguments.path, job.stage(0.0, 0.5, "converting"));
        if (!path) return tl::unexpected(std::move(path.error()));
        reading = job.stage(0.5, 1.0, "loading");
    }
    Result<ProjectContent> read = readProject(*path, arguments.annotations);
    if (!read) return tl::unexpected(std::move(read.error()));
    const planning::PlanParams stored = read->params;
    const nlohmann::json stored_import = read->import;
    if (Status status = applyArguments(arguments, read->params); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    warnOfArgumentsWithoutEffect(arguments, read->params);
    read->import = importSettings(arguments, stored_import);
    if (Status status = addCloudSettings(arguments, read->import); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    Result<std::shared_ptr<const Scene>> imported = importSceneOf(*read, reading);
    if (!imported) return tl::unexpected(std::move(imported.error()));
    if (!arguments.reports_import) {
        warnOfAll("import", (*imported)->report.warnings);
        warnOfTextures((*imported)->report);
    }
    const Result<std::vector<std::string>> lost = numberEdits(*read, **imported);
    if (!lost) return tl::unexpected(lost.error());
    warnOfAll("annotations", *lost);
    OpenedScene opened;
    opened.imported = std::move(*imported);
    opened.params = read->params;
    opened.import = read->import;
    opened.stored_result = std::move(read->result);
    opened.edits_section = std::move(read->edits_section);
    opened.project_others = std::move(read->others);
    // The editor's view: another unit or axis moves everything, other options renumber objects.
    if (opened.import != stored_import) opened.project_others.erase("view");
    if (Status status = applyEditsAndArguments(opened, read->edits, arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const bool other_edits = opened.edits != read->edits;
    if (opened.stored_result.is_null()) return opened;
    const bool other_scene = read->planned_sha256 != opened.imported->source_sha256;
    const bool other_import = opened.import != stored_import;
    if (other_scene || other_import || other_edits ||
        !planning::makeSamePlan(stored, opened.params)) {
        const std::string changed = other_import  ? "the import settings"
                                    : other_edits ? "constraints of the trajectory"
                                                  : changedNames(stored, opened.params);
        log::warn(
            "project",
            other_scene
                ? "the scene file has changed since it was planned: planning again, so the "
                  "views will differ"
                : "changed since it was planned: " + changed +
                      "; planning again, so the views will differ" +
                      (other_import || other_edits ? "" : planningOnceText(stored, opened.params)));
        opened.stored_result = nullptr;
    }
    return opened;
}

}  // namespace dollytrack::cli
