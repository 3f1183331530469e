#include "render/verify/verify.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <optional>

namespace dollytrack::verify {
namespace {

/// Frames looked at between two reports of progress: enough for any number of threads, few enough
/// that what each found fits into memory.
constexpr std::size_t kFramesAtOnce = 32;

std::string whySkipped(const Check& check, const Subject& subject, const std::string& no_scene) {
    for (const char* const name : check.needs) {
        if (!subject.dataset.has(name)) return std::string("the dataset has no ") + name;
    }
    const auto has = [&](const char* name) { return subject.dataset.has(name); };
    if (!check.one_of.empty() && std::none_of(check.one_of.begin(), check.one_of.end(), has)) {
        std::string names;
        for (const char* const name : check.one_of)
            names += (names.empty() ? "" : ", ") + std::string(name);
        return "the dataset has none of " + names;
    }
    if (check.needs_scene && !subject.rays) return no_scene;
    return {};
}

/// A damaged dataset may surprise a check: that is a finding, and the others go on.
template <class Work>
void guarded(Findings& findings, std::optional<int> frame, const Work& work) {
    try {
        work();
    } catch (const std::exception& error) {
        findings.add({"dataset.json", frame, {}, error.what(), "what this check can read"});
    }
}

}  // namespace

Result<std::vector<CheckResult>> verifyDataset(const Subject& subject, const std::string& no_scene,
                                               const JobContext& job) {
    const auto cancelled = [] { return fail(ErrorCode::Cancelled, "The check was stopped."); };
    std::vector<CheckResult> results;
    std::vector<CheckWork> works;
    for (const Check& check : checks()) {
        CheckResult result{&check, whySkipped(check, subject, no_scene), {}};
        works.emplace_back();
        if (result.skipped.empty()) {
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
        guarded(results[c].findings, {}, [&] { works[c].finish(results[c].findings); });
    }
    return results;
}

bool isSound(const std::vector<CheckResult>& results) {
    return std::none_of(results.begin(), results.end(),
                        [](const CheckResult& one) { return one.failed(); });
}

}  // namespace dollytrack::verify
