#include "render/verify/verify.h"

#include "engine/io/files/bounded_json.h"
#include "engine/jobs/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace dollytrack::verify {
namespace {

/// Frames processed between two progress reports: enough for any number of threads, few enough that
/// their findings fit into memory.
constexpr std::size_t kFramesAtOnce = 32;

/// The result of a check that has not run: whether it is skipped, and why.
CheckResult begun(const Check& check, const Subject& subject, const std::string& no_scene) {
    for (const char* const name : check.needs) {
        if (subject.dataset.has(name)) continue;
        return {&check, Skip::NoFiles, std::string("the dataset has no ") + name, {}};
    }
    const auto has = [&](const char* name) { return subject.dataset.has(name); };
    if (!check.one_of.empty() && std::none_of(check.one_of.begin(), check.one_of.end(), has)) {
        return {&check,
                Skip::NoFiles,
                fmt::format("the dataset has none of {}", fmt::join(check.one_of, ", ")),
                {}};
    }
    if (const char* missing = check.missing ? check.missing() : nullptr) {
        return {&check, Skip::NoLibrary, missing, {}};
    }
    if (check.needs_scene && !subject.rays) return {&check, Skip::NoScene, no_scene, {}};
    return {&check, Skip::None, {}, {}};
}

/// A damaged dataset may make a check throw; this becomes a finding, and other checks continue.
template <class Work>
void guarded(Findings& findings, std::optional<int> frame, const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        findings.add(
            {"dataset.json", frame, {}, plainReason(error), "files that this check can read"});
    }
}

/// A frame costs time even if it is only listed, so a short dataset.json could cause hours of work.
/// A dataset that lacks most of its images is refused before any frame is processed.
Status checkImagesAreThere(const StoredDataset& dataset) {
    constexpr std::size_t kAlwaysChecked = 20'000;  // images: below this number each missing one is
                                                    // reported
    const std::size_t kinds = std::ranges::count_if(
        imageKinds(), [&](const ImageKind& k) { return dataset.has(k.modality); });
    const std::size_t listed = kinds * dataset.frames.size();
    if (listed <= kAlwaysChecked) return {};
    std::size_t there = 0;
    std::error_code error;
    namespace fs = std::filesystem;
    for (fs::recursive_directory_iterator at(dataset.folder, error);
         !error && at != fs::recursive_directory_iterator() && 2 * there < listed;
         at.increment(error)) {
        ++there;
    }
    if (2 * there >= listed) return {};
    return fail(ErrorCode::BadInput,
                fmt::format("It lists {} frames, but most of their images are missing: the folder "
                            "holds {} files; export the dataset again.",
                            dataset.frames.size(), there),
                (dataset.folder / "dataset.json").string());
}

}  // namespace

Result<std::vector<CheckResult>> verifyDataset(const Subject& subject, const std::string& no_scene,
                                               const JobContext& job) {
    const auto cancelled = [] { return fail(ErrorCode::Cancelled, "The check was stopped."); };
    if (const Status status = checkImagesAreThere(subject.dataset); !status) {
        return tl::unexpected(status.error());
    }
    std::vector<CheckResult> results;
    std::vector<CheckWork> works;
    for (const Check& check : checks()) {
        CheckResult result = begun(check, subject, no_scene);
        works.emplace_back();
        if (result.skip == Skip::None) {
            guarded(result.findings, {},
                    [&] { works.back() = check.begin(subject, result.findings); });
        }
        results.push_back(std::move(result));
    }
    const std::size_t frames = subject.dataset.frames.size();
    for (std::size_t begin = 0; begin < frames; begin += kFramesAtOnce) {
        const std::size_t count = std::min(kFramesAtOnce, frames - begin);
        std::vector<std::vector<Findings>> found(count, std::vector<Findings>(works.size()));
        parallelFor(count, [&](std::size_t i) {
            FrameImages images(subject.dataset, static_cast<int>(begin + i));
            for (std::size_t c = 0; c < works.size() && !job.cancelled(); ++c) {
                if (!works[c].frame) continue;
                guarded(found[i][c], images.frame(), [&] { works[c].frame(images, found[i][c]); });
            }
        });
        if (job.cancelled()) return cancelled();
        for (const auto& of_frame : found) {
            for (std::size_t c = 0; c < works.size(); ++c) results[c].findings.append(of_frame[c]);
        }
        job.reportItems(static_cast<int>(begin + count), static_cast<int>(frames));
    }
    for (std::size_t c = 0; c < works.size(); ++c) {
        if (job.cancelled()) return cancelled();
        if (!works[c].finish) continue;
        guarded(results[c].findings, {}, [&] { works[c].finish(results[c].findings, job); });
    }
    if (job.cancelled()) return cancelled();
    return results;
}

bool isSound(const std::vector<CheckResult>& results) {
    return std::none_of(results.begin(), results.end(),
                        [](const CheckResult& one) { return one.failed(); });
}

}  // namespace dollytrack::verify
