#include "app/outcomes/outcome_run.h"

#include "app/batch/batch_folder.h"
#include "app/batch/batch_runner.h"
#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace dollytrack::outcomes {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Far from the planners' seeds, so that no test view equals a training frame.
constexpr int kTestSeedsFrom = 1000;

struct TestKind {
    const char* distribution;
    const char* planner;
};
constexpr TestKind kTests[] = {
    {"uniform", "uniform"}, {"object_facing", "object-facing"}, {"close", "close-views"}};

/// A set of frames to export and its purpose.
struct FrameSet {
    batch::Job job;
    Entry entry;
    std::string distribution;  // distribution of a test set; empty for a planner's frames
};

std::string folderName(std::string name) {
    std::ranges::replace(name, '/', '_');
    return name;
}

class Measurement {
  public:
    Measurement(const OutcomeOrder& order, const JobContext& job) : order_(order), job_(job) {}

    Result<OutcomeReport> run() {
        if (Status status = checkJudges(); !status) {
            return tl::unexpected(std::move(status.error()));
        }
        listSets();
        if (Status status = exportFrames(job_.stage(0.0, 0.5, "frames")); !status) {
            return tl::unexpected(std::move(status.error()));
        }
        if (Status status = writeReferences(job_.stage(0.5, 0.55, "reference surfaces")); !status) {
            return tl::unexpected(std::move(status.error()));
        }
        const auto count = static_cast<double>(order_.judges.size());
        for (std::size_t i = 0; i < order_.judges.size(); ++i) {
            const JudgeProgram& judge = order_.judges[i];
            const JobContext part =
                job_.stage(0.55 + 0.45 * static_cast<double>(i) / count,
                           0.55 + 0.45 * static_cast<double>(i + 1) / count, judge.name);
            part.report(0.0);
            Result<JudgeOutcome> outcome = askJudge(judge, checks_[i], part);
            if (!outcome) return tl::unexpected(std::move(outcome.error()));
            report_.judges.push_back(std::move(*outcome));
        }
        return std::move(report_);
    }

  private:
    [[nodiscard]] JudgeSettings settingsOf(const JudgeProgram& judge) const {
        return {order_.folder / "judges" / judge.name, order_.timeout_s};
    }

    /// Checked before the exports, which can take hours, to report missing dependencies at once.
    Status checkJudges() {
        for (const JudgeProgram& judge : order_.judges) {
            JudgeSettings settings = settingsOf(judge);
            settings.folder /= "check";  // keeps the log of an earlier run
            std::error_code error;
            fs::create_directories(settings.folder, error);
            const fs::path file = settings.folder / "request.json";
            if (Status status = writeJson(file, choicesOf(judge)); !status) return status;
            Result<JudgeEnd> end = checkJudge(judge, settings, file, job_);
            if (!end) return tl::unexpected(std::move(end.error()));
            if (end->how == JudgeEnd::How::Done) {
                available_.push_back(judge);
            } else {
                log::warn("compare", fmt::format("{}: {}", judge.name, end->text));
            }
            checks_.push_back(std::move(*end));
        }
        return {};
    }

    /// The user's options and programs for a judge.
    [[nodiscard]] Json choicesOf(const JudgeProgram& judge) const {
        return {{"seed", order_.first_seed},
                {"options", order_.options.value(judge.name, Json::object())},
                {"programs", order_.programs.value(judge.name, Json::array())}};
    }

    static std::string textOf(const Json& json) {
        return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    }

    static Status writeJson(const fs::path& file, const Json& json) {
        return writeWhole(file, textOf(json));
    }

    void listSets() {
        for (const ComparedFile& scene : order_.scenes) {
            for (int seed = order_.first_seed; seed < order_.first_seed + order_.seeds; ++seed) {
                for (const std::string& planner : order_.planners) {
                    addSet(scene, planner, planner, seed, order_.frames, "");
                }
                if (!order_.controls) continue;
                addSet(scene, againName(order_), order_.planners.front(), seed, order_.frames, "");
                addSet(scene, kStareName, kStareName, seed, order_.frames, "");
            }
            addTests(scene);
        }
        for (const ComparedFile& scene : order_.test_scenes) addTests(scene);
    }

    void addTests(const ComparedFile& scene) {
        if (!std::ranges::any_of(available_, &JudgeProgram::wants_tests)) return;
        for (const TestKind& test : kTests) {
            addSet(scene, std::string("test-") + test.distribution, test.planner,
                   kTestSeedsFrom + order_.first_seed, order_.test_frames, test.distribution);
        }
    }

    void addSet(const ComparedFile& scene, const std::string& name, const std::string& planner,
                int seed, int frames, const std::string& distribution) {
        FrameSet set;
        set.job.number = static_cast<int>(sets_.size()) + 1;
        set.job.name = fmt::format("{}.{}.seed{}", folderName(scene.name), name, seed);
        set.job.scene = fs::absolute(scene.path).lexically_normal();
        set.job.planner = planner;
        set.job.seed = seed;
        set.job.command = "export";
        set.job.arguments = order_.export_arguments;
        set.job.arguments.insert(
            set.job.arguments.end(),
            {"--planner", planner, "--seed", std::to_string(seed), "--max-frames",
             std::to_string(frames), "--modalities", "rgb,depth,instance,semantic", "--formats",
             "coco,frames,instances,tum"});
        set.entry = {name, scene.name, seed, {}, 0};
        set.distribution = distribution;
        sets_.push_back(std::move(set));
    }

    Status exportFrames(const JobContext& job) {
        if (available_.empty()) {
            for (const FrameSet& set : sets_) report_.entries.push_back(set.entry);
            report_.notes.emplace_back("No judge can run, so no frames were exported.");
            return {};
        }
        Result<fs::path> program = batch::ownProgram();
        if (!program) return tl::unexpected(std::move(program.error()));
        batch::RunSettings settings;
        settings.program = program_ = std::move(*program);
        settings.version = order_.version;
        settings.folder = order_.folder / "frames";
        settings.threads = order_.threads;
        std::vector<batch::Job> jobs;
        for (const FrameSet& set : sets_) jobs.push_back(set.job);
        if (Status status = batch::claimBatchFolder(settings.folder, {jobs, {}}); !status) {
            return status;
        }
        const std::vector<batch::JobResult> results = batch::runJobs(jobs, settings, job);
        if (job.cancelled()) {
            return fail(ErrorCode::Cancelled,
                        "The exports were stopped; the same command resumes them.");
        }
        for (std::size_t i = 0; i < results.size(); ++i) takeFrames(results[i], sets_[i]);
        const bool any = std::ranges::any_of(
            report_.entries, [](const Entry& entry) { return !entry.dataset.empty(); });
        if (any) return {};
        return fail(ErrorCode::Failed,
                    "No planner's frames could be exported; see the messages above.",
                    settings.folder.string());
    }

    void takeFrames(const batch::JobResult& result, FrameSet& set) {
        Entry& entry = set.entry;
        const std::string who =
            fmt::format("{} in {}, seed {}", entry.planner, entry.scene, entry.seed);
        scene_hashes_[entry.scene] = result.scene.sha256;
        if (result.state != batch::JobState::Done || result.datasets.size() != 1) {
            std::string why = result.message;
            if (result.state == batch::JobState::Done) {
                why = fmt::format(
                    "the export wrote {} datasets, one per room; exactly one can be "
                    "judged",
                    result.datasets.size());
            }
            report_.notes.push_back(
                fmt::format("{}: no frames: {}{}", who, why, why.ends_with('.') ? "" : "."));
        } else {
            entry.frames = result.datasets.front().frames;
            entry.dataset =
                order_.folder / "frames" / set.job.name / result.datasets.front().folder;
            const int wanted = set.distribution.empty() ? order_.frames : order_.test_frames;
            if (entry.frames != wanted) {
                report_.notes.push_back(
                    fmt::format("{}: {} frames instead of {}.", who, entry.frames, wanted));
            }
        }
        if (set.distribution.empty()) report_.entries.push_back(entry);
    }

    [[nodiscard]] fs::path referenceOf(const std::string& scene) const {
        return order_.folder / "references" / (folderName(scene) + ".npy");
    }

    Status writeReferences(const JobContext& job) {
        if (!std::ranges::any_of(available_, &JudgeProgram::wants_surface)) return {};
        for (std::size_t i = 0; i < order_.scenes.size(); ++i) {
            const ComparedFile& scene = order_.scenes[i];
            const auto count = static_cast<double>(order_.scenes.size());
            const JobContext part = job.stage(static_cast<double>(i) / count,
                                              static_cast<double>(i + 1) / count, scene.name);
            const fs::path file = referenceOf(scene.name);
            const fs::path key_file = fs::path(file).replace_extension(".key");
            const std::string key =
                fmt::format("{} {} {}\n", order_.version, scene_hashes_[scene.name],
                            fmt::join(order_.export_arguments, " "));
            std::error_code error;
            if (fs::exists(file, error) && readText(key_file).value_or("") == key) continue;
            fs::create_directories(file.parent_path(), error);
            cli::SceneArguments arguments = order_.each;
            arguments.path = scene.path.string();
            arguments.one_of_several = order_.scenes.size() > 1;
            Status written = writeReferenceSurface(arguments, file, part);
            if (written) written = writeWhole(key_file, key);
            if (written) continue;
            const ErrorCode code = written.error().code;
            if (code == ErrorCode::Cancelled || code == ErrorCode::CannotWrite) return written;
            report_.notes.push_back(
                fmt::format("{}: no reference surface: {}", scene.name, describe(written.error())));
        }
        return {};
    }

    /// Hashes of all Python files in the judge's folder, by name, since it may import any of them.
    static Result<Json> codeHashes(const JudgeProgram& judge) {
        std::map<std::string, std::string> hashes;
        std::error_code error;
        for (auto entry = fs::directory_iterator(judge.path.parent_path(), error);
             !error && entry != fs::directory_iterator(); entry.increment(error)) {
            if (entry->path().extension() != ".py") continue;
            Result<std::string> hash = sha256OfFile(entry->path());
            if (!hash) return tl::unexpected(std::move(hash.error()));
            hashes[entry->path().filename().string()] = std::move(*hash);
        }
        Json json = Json::object();
        for (const auto& [name, hash] : hashes) json[name] = hash;
        return json;
    }

    /// The judge's request. It contains hashes of the datasets and the judge's code, and all
    /// versions: an earlier result is reused only for an equal request.
    Result<Json> requestFor(const JudgeProgram& judge, const std::string& versions) const {
        Result<Json> hashes = codeHashes(judge);
        if (!hashes) return hashes;
        Json request = choicesOf(judge);
        request.update({{"code_sha256", std::move(*hashes)},
                        {"program", program_.string()},
                        {"version", order_.version},
                        {"versions", versions},
                        {"work", (settingsOf(judge).folder / "work").string()},
                        {"references", Json::object()},
                        {"entries", Json::array()},
                        {"tests", Json::array()}});
        for (const ComparedFile& scene : order_.scenes) {
            const fs::path file = referenceOf(scene.name);
            std::error_code error;
            if (judge.wants_surface && fs::exists(file, error)) {
                request["references"][scene.name] = file.string();
            }
        }
        for (const FrameSet& set : sets_) {
            const Entry& entry = set.entry;
            if (entry.dataset.empty()) continue;
            const Result<std::string> hash = sha256OfFile(entry.dataset / "dataset.json");
            if (!hash) return tl::unexpected(hash.error());
            if (set.distribution.empty()) {
                request["entries"].push_back({{"planner", entry.planner},
                                              {"scene", entry.scene},
                                              {"seed", entry.seed},
                                              {"dataset", entry.dataset.string()},
                                              {"dataset_sha256", *hash}});
            } else if (judge.wants_tests) {
                request["tests"].push_back({{"distribution", set.distribution},
                                            {"scene", entry.scene},
                                            {"dataset", entry.dataset.string()},
                                            {"dataset_sha256", *hash}});
            }
        }
        return request;
    }

    Result<JudgeOutcome> askJudge(const JudgeProgram& judge, const JudgeEnd& check,
                                  const JobContext& job) {
        JudgeOutcome outcome;
        outcome.judge = judge.name;
        outcome.text = judge.text;
        outcome.rows = emptyRows(report_.entries);
        if (check.how != JudgeEnd::How::Done) {
            outcome.state = stateOf(check.how);
            outcome.notes.push_back(check.text);
            return outcome;
        }
        outcome.versions = check.text;
        const JudgeSettings settings = settingsOf(judge);
        std::error_code error;
        fs::create_directories(settings.folder / "work", error);
        const Result<Json> request = requestFor(judge, check.text);
        if (!request) return tl::unexpected(request.error());
        const std::string text = textOf(*request);
        const fs::path request_file = settings.folder / "request.json";
        const bool asked_before = readText(request_file).value_or("") == text;
        if (asked_before && readOutcome(settings.folder, outcome)) return outcome;
        fs::remove(settings.folder / "result.json", error);
        if (Status status = writeWhole(request_file, text); !status) {
            return tl::unexpected(std::move(status.error()));
        }
        const auto entries = static_cast<int>((*request)["entries"].size());
        Result<JudgeEnd> end = runJudge(judge, settings, entries, job);
        if (!end) return tl::unexpected(std::move(end.error()));
        conclude(*end, settings.folder, outcome);
        return outcome;
    }

    /// Reads an existing result; returns whether it is valid.
    bool readOutcome(const fs::path& folder, JudgeOutcome& outcome) const {
        const Result<Json> json = readBoundedJson<Json>(folder / "result.json");
        return json && takeResult(*json, outcome).has_value();
    }

    [[nodiscard]] Status takeResult(const Json& json, JudgeOutcome& outcome) const {
        if (Status status = readResult(json, report_.entries, outcome); !status) return status;
        outcome.state = "done";
        if (order_.controls) {
            for (std::string& note :
                 controlNotes(outcome, order_.planners.front(), againName(order_), kStareName)) {
                outcome.notes.push_back(std::move(note));
            }
        }
        return {};
    }

    /// The state name of a judge without a result.
    static std::string stateOf(JudgeEnd::How how) {
        if (how == JudgeEnd::How::Missing) return "missing";
        return how == JudgeEnd::How::TimedOut ? "timed out" : "failed";
    }

    void conclude(const JudgeEnd& end, const fs::path& folder, JudgeOutcome& outcome) const {
        outcome.state = stateOf(end.how);
        if (end.how != JudgeEnd::How::Done) {
            outcome.notes.push_back(end.text);
            log::warn("compare", fmt::format("{}: {}", outcome.judge, end.text));
            return;
        }
        const Result<Json> json = readBoundedJson<Json>(folder / "result.json");
        const Status taken =
            json ? takeResult(*json, outcome) : Status(tl::unexpected(json.error()));
        if (taken) return;
        outcome.notes.push_back(describe(taken.error()));
        log::warn("compare", fmt::format("{}: {}", outcome.judge, describe(taken.error())));
    }

    const OutcomeOrder& order_;
    const JobContext& job_;
    fs::path program_;
    std::vector<JudgeEnd> checks_;  // by judge, in the order of order_.judges
    std::vector<JudgeProgram> available_;
    std::vector<FrameSet> sets_;
    std::map<std::string, std::string> scene_hashes_;  // by scene name
    OutcomeReport report_;
};

}  // namespace

std::string againName(const OutcomeOrder& order) {
    return order.planners.front() + "-again";
}

Result<OutcomeReport> measureOutcomes(const OutcomeOrder& order, const JobContext& job) {
    return Measurement(order, job).run();
}

}  // namespace dollytrack::outcomes
