#include "app/cli/command_line.h"
#include "app/cli/export/dataset_scene.h"
#include "app/cli/export/room_exports.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/terminal/terminal_text.h"
#include "render/formats/tables/dataset_card.h"
#include "render/verify/verify.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;
using verify::CheckResult;
using verify::Finding;
using verify::Skip;

struct VerifyArguments {
    std::string folder;
    DatasetSceneArguments scene;
    int show = 3;
    bool as_json = false;
};

struct Verified {
    std::string folder;
    std::size_t frames = 0;
    std::size_t files = 0;
    std::vector<CheckResult> results;
    render::PictureTally pictures;

    [[nodiscard]] std::ptrdiff_t count(Skip skip) const {
        return std::count_if(results.begin(), results.end(),
                             [&](const CheckResult& result) { return result.skip == skip; });
    }
};

/// The unusable images that dataset.json lists, which the check "usable" verifies. They do not
/// count as damage.
render::PictureTally picturesOf(const verify::StoredDataset& dataset) {
    try {
        return render::pictureTallyFrom(dataset.card.at("metrics").at("pictures"));
    } catch (const nlohmann::json::exception&) {  // an older or damaged dataset
        return {};
    }
}

/// The verdict; "sound as far as checked" if checks were skipped for lack of the scene or a
/// library.
std::string verdictOf(const Verified& verified) {
    if (!verify::isSound(verified.results)) return "DAMAGED";
    const bool is_whole =
        verified.count(Skip::NoScene) == 0 && verified.count(Skip::NoLibrary) == 0;
    return is_whole ? "sound" : "sound as far as checked";
}

/// The reasons for skipped checks: " (3 concern files that were not exported; 2 need the scene:
/// pass it with --scene)".
std::string whySkipped(const Verified& verified) {
    const std::ptrdiff_t absent = verified.count(Skip::NoFiles);
    const std::ptrdiff_t unproven = verified.count(Skip::NoScene);
    const std::ptrdiff_t libraries = verified.count(Skip::NoLibrary);
    std::vector<std::string> reasons;
    if (absent > 0) {
        reasons.push_back(fmt::format("{} concern{} files that were not exported", absent,
                                      absent == 1 ? "s" : ""));
    }
    if (unproven > 0) {
        reasons.push_back(fmt::format("{} need{} the scene: pass it with --scene", unproven,
                                      unproven == 1 ? "s" : ""));
    }
    if (libraries > 0) {
        reasons.push_back(fmt::format("{} need{} a library that is missing", libraries,
                                      libraries == 1 ? "s" : ""));
    }
    return reasons.empty() ? "" : fmt::format(" ({})", fmt::join(reasons, "; "));
}

const char* statusOf(const CheckResult& result) {
    if (result.failed()) return "failed";
    return result.passed() ? "passed" : "skipped";
}

nlohmann::json toJson(const Finding& finding) {
    nlohmann::json one = {{"file", finding.file}, {"found", finding.found}};
    if (finding.frame) one["frame"] = *finding.frame;
    if (finding.pixel) one["pixel"] = *finding.pixel;
    if (!finding.expected.empty()) one["expected"] = finding.expected;
    return one;
}

nlohmann::json toJson(const Verified& verified) {
    nlohmann::json checks = nlohmann::json::array();
    for (const CheckResult& result : verified.results) {
        nlohmann::json one = {{"check", result.check->name},
                              {"text", result.check->text},
                              {"status", statusOf(result)}};
        if (result.skip != Skip::None) one["reason"] = result.skip_reason;
        if (result.failed()) {
            one["count"] = result.findings.count;
            for (const Finding& finding : result.findings.first) {
                one["findings"].push_back(toJson(finding));
            }
        }
        checks.push_back(std::move(one));
    }
    return {{"dataset", verified.folder},
            {"frames", verified.frames},
            {"files", verified.files},
            {"sound", verify::isSound(verified.results)},
            {"pictures", render::pictureTallyJson(verified.pictures)},
            {"unproven_without_scene", verified.count(Skip::NoScene)},
            {"checks", std::move(checks)}};
}

std::string textOf(const Finding& finding) {
    std::string text = finding.file;
    if (finding.frame) text += fmt::format(", frame {}", *finding.frame);
    if (finding.pixel) {
        text += fmt::format(", pixel ({}, {})", (*finding.pixel)[0], (*finding.pixel)[1]);
    }
    text += ": " + finding.found;
    if (!finding.expected.empty()) text += "; expected " + finding.expected;
    return text;
}

/// Prints a check and its first `show` findings.
void print(const CheckResult& result, int show, std::size_t width) {
    fmt::print("  {:<20} {:<8} {}\n", result.check->name,
               result.failed() ? "FAILED" : statusOf(result),
               result.skip == Skip::None ? result.check->text : result.skip_reason.c_str());
    const auto& first = result.findings.first;
    const std::size_t shown = std::min(first.size(), static_cast<std::size_t>(show));
    for (std::size_t i = 0; i < shown; ++i) {
        fmt::print("{}", wrapped(textOf(first[i]), width, 8, "      - "));
    }
    if (result.findings.count > shown && result.failed()) {
        fmt::print("      and {} more\n", result.findings.count - shown);
    }
}

/// Prints the checks, those without files in the dataset as a list of names, and the verdict.
void print(const Verified& verified, int show) {
    fmt::print("{}: {} frames, {} files\n\n", verified.folder, verified.frames, verified.files);
    const std::size_t width = terminalWidth();
    std::vector<const char*> without_files;
    for (const CheckResult& result : verified.results) {
        if (result.skip == Skip::NoFiles) {
            without_files.push_back(result.check->name);
        } else {
            print(result, show, width);
        }
    }
    if (!without_files.empty()) {
        fmt::print("{}", wrapped(fmt::format("{}", fmt::join(without_files, ", ")), width, 4,
                                 "  skipped, as their files were not exported: "));
    }
    const std::string unusable = render::unusableText(verified.pictures);
    if (!unusable.empty()) fmt::print("\nnote: {}\n", unusable);
    const auto& results = verified.results;
    const auto passed = std::count_if(results.begin(), results.end(),
                                      [](const CheckResult& result) { return result.passed(); });
    const auto failed = std::count_if(results.begin(), results.end(),
                                      [](const CheckResult& result) { return result.failed(); });
    fmt::print("\n{} passed, {} failed, {} skipped{}: {}\n\n", passed, failed,
               static_cast<std::ptrdiff_t>(results.size()) - verified.count(Skip::None),
               whySkipped(verified), verdictOf(verified));
}

Result<Verified> verifyOne(const fs::path& folder, const VerifyArguments& arguments,
                           const JobContext& job) {
    const auto dataset = verify::readStoredDataset(folder);
    if (!dataset) return tl::unexpected(dataset.error());
    const auto scene = openDatasetScene(*dataset, arguments.scene, job.stage(0.0, 0.1, "loading"));
    if (!scene) return tl::unexpected(scene.error());
    auto results = verify::verifyDataset({*dataset, scene->scene.get(), scene->rays.get()},
                                         scene->missing, job.stage(0.1, 1.0, "frames"));
    if (!results) return tl::unexpected(std::move(results.error()));
    return Verified{folder.string(), dataset->frames.size(), dataset->sha256s.size() + 1,
                    std::move(*results), picturesOf(*dataset)};
}

/// The datasets to verify, and those that are missing.
struct Datasets {
    std::vector<fs::path> folders;
    std::vector<std::string> missing;  // rooms without a dataset
};

/// The datasets in a folder: the folder itself, or one per room.
Result<Datasets> datasetsIn(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder / "dataset.json", error) || !holdsRooms(folder))
        return Datasets{{folder}, {}};
    const auto rooms = roomFolders(folder);
    if (!rooms) return tl::unexpected(rooms.error());
    Datasets found;
    for (const fs::path& room : *rooms) {
        if (fs::exists(room / "dataset.json", error)) {
            found.folders.push_back(room);
        } else {
            found.missing.push_back(room.filename().string());
        }
    }
    return found;
}

nlohmann::json toJson(nlohmann::json datasets, const std::vector<std::string>& missing,
                      bool sound) {
    if (datasets.size() == 1 && missing.empty()) return std::move(datasets[0]);
    nlohmann::json all = {{"sound", sound}, {"datasets", std::move(datasets)}};
    if (!missing.empty()) all["missing"] = missing;
    return all;
}

Result<ExitCode> runVerify(const VerifyArguments& arguments, const Session& session) {
    const JobContext job = session.job();
    const Result<Datasets> datasets = datasetsIn(arguments.folder);
    if (!datasets) return tl::unexpected(datasets.error());
    const std::vector<fs::path>& folders = datasets->folders;
    const std::vector<std::string>& missing = datasets->missing;
    bool sound = missing.empty();
    nlohmann::json all = nlohmann::json::array();
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const auto share = [&](std::size_t n) {
            return static_cast<double>(n) / static_cast<double>(folders.size());
        };
        const auto one =
            verifyOne(folders[i], arguments, job.stage(share(i), share(i + 1), "frames"));
        if (!one) return tl::unexpected(one.error());
        sound = sound && verify::isSound(one->results);
        if (arguments.as_json) {
            all.push_back(toJson(*one));
        } else {
            print(*one, arguments.show);
        }
    }
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(toJson(std::move(all), missing, sound)));
    } else if (!missing.empty()) {
        fmt::print(
            "UNFINISHED: {} of {} rooms in rooms.json ha{} no complete dataset: {}; 'export "
            "--resume' finishes them\n",
            missing.size(), missing.size() + folders.size(), missing.size() == 1 ? "s" : "ve",
            fmt::join(missing, ", "));
    }
    return sound ? kDone : kBadInput;
}

}  // namespace

void addVerifyCommand(CLI::App& app, Session& session) {
    CLI::App* command =
        app.add_subcommand("verify", "Check a dataset's files against each other and the scene");
    auto arguments = std::make_shared<VerifyArguments>();
    command
        ->add_option("dataset", arguments->folder, "Folder of a dataset, or of datasets per room")
        ->required()
        ->type_name("DIR");
    addDatasetSceneArguments(*command, arguments->scene);
    command->add_option("--show", arguments->show, "Number of findings to print per check")
        ->check(CLI::Range(0, 20).description("0 .. 20"))
        ->type_name("N");
    command->add_flag("--json", arguments->as_json, "Print the result as JSON");
    command->add_flag_callback(
        "--list",
        [] {
            for (const verify::Check& check : verify::checks()) {
                fmt::print("{:<20} {}{}\n", check.name, check.text,
                           check.needs_scene ? " (needs the scene)" : "");
            }
            throw CLI::Success();
        },
        "List the checks, then exit");
    command->footer(
        "Exit code 0 if every check that could run passed, 4 if one failed.\n"
        "A check is skipped if the dataset lacks the files for it, or if the scene is found "
        "neither\n"
        "at its original path nor beside the dataset, in the working folder, where a batch had "
        "it,\n"
        "or where projects in those folders have it.\n"
        "Example: dollytrack verify dataset --scene room.glb");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runVerify(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
