#include "app/batch/jobs_file.h"

#include "app/batch/table_reader.h"
#include "app/batch/toml_depth.h"
#include "app/cli/requirement.h"
#include "engine/core/field_list.h"
#include "engine/io/files/text_file.h"
#include "engine/math/up_axis.h"
#include "planning/baselines/planner.h"
#include "planning/plan_params.h"
#include "render/dataset/export_preset.h"
#include "render/dataset/frame_range.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace dollytrack::batch {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<Placed<std::string>>;

constexpr std::size_t kMostMebibytes = 16;  // size limit of a jobs file
constexpr std::size_t kMostJobs = 100'000;

std::vector<std::string> valuesOf(const Texts& texts) {
    std::vector<std::string> values;
    for (const auto& one : texts) values.push_back(one.value);
    return values;
}

/// The value in the form of --set; nullopt for types that no parameter has.
std::optional<std::string> assignedText(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    if (const auto number = node.value_exact<std::int64_t>()) return fmt::format("{}", *number);
    if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
    if (const auto on = node.value_exact<bool>()) return *on ? "true" : "false";
    return std::nullopt;
}

class OrderReader {
  public:
    OrderReader(const fs::path& file, const toml::table& root)
        : file_(file), reader_(root, file.string()) {
        order_.file = file;
    }

    Result<BatchOrder> read() {
        std::string out;
        reader_.read("out", out);
        if (!out.empty()) order_.out = besideFile(out);
        readImport();
        readSets();
        readPlanners();
        reader_.read("seeds", order_.seeds, 0, std::numeric_limits<int>::max());
        readExport();
        readRequirements();
        std::optional<double> seconds;
        reader_.read("timeout_s", seconds, 0.001, 1e9);
        order_.timeout_s = seconds.value_or(0.0);
        std::optional<int> megabytes;
        reader_.read("memory_mb", megabytes, 1, std::numeric_limits<int>::max());
        order_.memory_mb = static_cast<std::uint64_t>(megabytes.value_or(0));
        Texts scenes;
        Texts excluded;
        reader_.read("scenes", scenes);
        reader_.read("exclude", excluded);
        refuseTwice();
        if (Status status = reader_.finish(); !status) return tl::unexpected(status.error());
        // Errors in the file are reported before a possibly slow disk is searched.
        return findScenes(scenes, excluded).map([&] { return std::move(order_); });
    }

  private:
    /// Relative paths are relative to the jobs file.
    fs::path besideFile(const std::string& path) const { return file_.parent_path() / path; }

    void readImport() {
        const toml::table* table = reader_.table("import");
        if (table == nullptr) return;
        TableReader import(*table, file_.string());
        import.read("unit_m", order_.unit_m, 1e-6, 1e6);
        import.read("up", order_.up_axis);
        if (order_.up_axis && !parseUpAxis(*order_.up_axis)) {
            import.refuse(import.placeOf("up"), fmt::format("'up' must be {}.", kUpAxes));
        }
        std::optional<std::string> labels;
        import.read("labels", labels);
        if (labels) order_.labels = besideFile(*labels);
        if (labels && !fs::exists(*order_.labels)) {
            import.refuse(import.placeOf("labels"), "there is no file '" + *labels + "'");
        }
        Texts models;
        import.read("models", models);
        for (const Placed<std::string>& folder : models) {
            order_.models.push_back(besideFile(folder.value));
            if (!fs::is_directory(order_.models.back())) {
                import.refuse(folder.where, "there is no folder '" + folder.value + "'");
            }
        }
        std::optional<std::string> annotations;
        import.read("annotations", annotations);
        if (annotations) order_.annotations = besideFile(*annotations);
        if (annotations && !fs::exists(*order_.annotations)) {
            import.refuse(import.placeOf("annotations"), "there is no '" + *annotations + "'");
        }
        import.read("convert", order_.convert);
        passOn(import.finish());
    }

    void readSets() {
        std::set<std::string> names;
        planning::PlanParams params;
        const FieldList fields = planning::listFields(params);
        for (const toml::table* table : reader_.tables("set")) {
            TableReader reader(*table, file_.string());
            ParameterSet set;
            reader.read("name", set.name);
            if (set.name.empty() || asName(set.name) != set.name) {
                reader.refuse(reader.placeOf("name"),
                              "Each [[set]] needs a name of letters, digits, '-' and '_', which "
                              "becomes part of folder names.");
            }
            if (!names.insert(set.name).second) {
                reader.refuse(reader.placeOf("name"),
                              fmt::format("There are two sets named '{}'.", set.name));
            }
            if (const toml::table* values = reader.table("set")) {
                for (const auto& [key, node] : *values) {
                    const auto text = assignedText(node);
                    const std::string assignment =
                        fmt::format("{}={}", key.str(), text.value_or("?"));
                    if (const Status status = setField(fields, assignment); !status) {
                        reader.refuse(reader.placeOf(node), describe(status.error()));
                    }
                    set.assignments.push_back(assignment);
                }
            }
            passOn(reader.finish());
            order_.sets.push_back(std::move(set));
        }
    }

    void readPlanners() {
        Texts names;
        reader_.read("planners", names);
        for (const auto& name : names) {
            const auto chosen = planning::choosePlanners({name.value});
            if (!chosen) {
                reader_.refuse(name.where, describe(chosen.error()));
                continue;
            }
            for (const planning::Planner* planner : *chosen) {
                const std::string one(planner->name);
                auto& all = order_.planners;
                if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
            }
        }
    }

    void readExport() {
        const toml::table* table = reader_.table("export");
        if (table == nullptr) return;
        TableReader reader(*table, file_.string());
        ExportOrder exports;
        reader.read("max_frames", exports.max_frames, 0, std::numeric_limits<int>::max());
        reader.read("range", exports.range);
        if (!exports.range.empty()) {
            if (const auto range = render::parseFrameRange(exports.range); !range) {
                reader.refuse(reader.placeOf("range"), range.error().message);
            }
        }
        reader.read("preset", exports.preset);
        render::DatasetSettings unused;
        if (const Status known = render::applyPreset(exports.preset, unused); !known) {
            reader.refuse(reader.placeOf("preset"), known.error().message);
        }
        Texts modalities;
        Texts formats;
        Texts arguments;
        reader.read("modalities", modalities);
        reader.read("formats", formats);
        reader.read("arguments", arguments);
        for (const auto& one : modalities) {
            const auto chosen = render::chooseModalities({one.value});
            if (!chosen) reader.refuse(one.where, chosen.error().message);
        }
        for (const auto& one : formats) {
            const auto chosen = render::chooseFormats({one.value});
            if (!chosen) reader.refuse(one.where, chosen.error().message);
        }
        for (const auto& one : arguments) {
            for (const char* own : {"--out", "--json", "--resume", "--overwrite", "--planner",
                                    "--seed", "--progress", "--modalities", "--formats", "--preset",
                                    "--range", "--max-frames", "--threads", "--list"}) {
                if (one.value != own && !one.value.starts_with(std::string(own) + "=")) continue;
                reader.refuse(
                    one.where,
                    fmt::format("'{}' is not allowed in 'arguments', because the batch sets it.",
                                own));
            }
        }
        exports.modalities = valuesOf(modalities);
        exports.formats = valuesOf(formats);
        exports.arguments = valuesOf(arguments);
        passOn(reader.finish());
        order_.exports = std::move(exports);
    }

    void readRequirements() {
        Texts texts;
        reader_.read("require", texts);
        for (const auto& one : texts) {
            if (const auto parsed = cli::parseRequirement(one.value); !parsed) {
                reader_.refuse(one.where, parsed.error().message);
            }
        }
        order_.require = valuesOf(texts);
        for (const auto& one : texts) order_.require_places.push_back(one.where);
    }

    /// Refuses values given in two places, of which only one would apply.
    void refuseTwice() {
        for (const ParameterSet& set : order_.sets) {
            for (const std::string& assignment : set.assignments) {
                const bool seed = assignment.starts_with("seed=") && !order_.seeds.empty();
                const bool frames = assignment.starts_with("max_frames=") && order_.exports &&
                                    order_.exports->max_frames;
                if (!seed && !frames) continue;
                reader_.refuse(
                    reader_.placeOf("set"),
                    fmt::format(
                        "The set '{}' has {}, but '{}' is given as well; remove one of them.",
                        set.name, assignment, seed ? "seeds" : "max_frames of [export]"));
            }
        }
    }

    Status findScenes(const Texts& patterns, const Texts& excluded) {
        if (patterns.empty()) {
            return fail(ErrorCode::BadInput,
                        "The file lists no scenes; add a line like scenes = [\"rooms/*.glb\"].",
                        file_.string());
        }
        std::set<std::string> known;
        for (const auto& pattern : patterns) {
            Result<std::vector<SceneFile>> found =
                filesMatching(pattern.value, file_.parent_path());
            if (!found) return fail(ErrorCode::BadInput, describe(found.error()), pattern.where);
            for (SceneFile& scene : *found) {
                if (!known.insert(scene.path.string()).second) continue;
                const auto left_out = [&](const auto& one) {
                    return matches(scene.path, one.value);
                };
                if (std::any_of(excluded.begin(), excluded.end(), left_out)) continue;
                order_.scenes.push_back(std::move(scene));
            }
        }
        if (order_.scenes.empty()) {
            return fail(ErrorCode::BadInput, "'exclude' leaves no scene.",
                        reader_.placeOf("exclude"));
        }
        nameScenes(order_.scenes);
        return checkJobCount();
    }

    [[nodiscard]] Status checkJobCount() const {
        double jobs = 1.0;  // the product of four list lengths may not fit into an integer
        for (const std::size_t count : {order_.scenes.size(), order_.sets.size(),
                                        order_.planners.size(), order_.seeds.size()}) {
            jobs *= static_cast<double>(std::max<std::size_t>(count, 1));
        }
        if (jobs <= kMostJobs) return {};
        return fail(ErrorCode::BadInput,
                    fmt::format("The scenes, sets, planners and seeds make {:.0f} jobs, but at "
                                "most {} are possible; divide "
                                "them among several files.",
                                jobs, kMostJobs),
                    file_.string());
    }

    void passOn(const Status& status) {
        if (!status) reader_.refuse(status.error().where, status.error().message);
    }

    fs::path file_;
    TableReader reader_;
    BatchOrder order_;
};

}  // namespace

Result<BatchOrder> readJobsFile(const fs::path& file) {
    std::error_code error;
    const Result<std::string> text = readText(file, kMostMebibytes);
    if (!text || text->empty()) {
        return fail(ErrorCode::BadInput,
                    fs::is_directory(file, error) ? "this is a folder; give the jobs file in it"
                    : !fs::exists(file, error)
                        ? "there is no such file; the guide Batches has an example"
                    : text ? "the jobs file is empty"
                           : text.error().message,
                    file.string());
    }
    if (Status status = checkTomlDepth(*text, file.string()); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const toml::parse_result parsed = toml::parse(*text, file.string());
    if (!parsed) {
        return fail(ErrorCode::BadInput, std::string(parsed.error().description()) + ".",
                    fmt::format("{}:{}", file.string(), parsed.error().source().begin.line));
    }
    return OrderReader(file, parsed.table()).read();
}

}  // namespace dollytrack::batch
