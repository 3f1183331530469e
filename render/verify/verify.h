#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/verify/checks.h"

#include <string>
#include <vector>

namespace dollytrack::verify {

/// Why a check did not run: the dataset lacks its files, the scene is missing, or a library is not
/// installed. None: it ran.
enum class Skip { None, NoFiles, NoScene, NoLibrary };

/// Result of one check.
struct CheckResult {
    const Check* check = nullptr;
    Skip skip = Skip::None;
    std::string skip_reason;  // empty if it ran
    Findings findings;

    [[nodiscard]] bool passed() const { return skip == Skip::None && findings.count == 0; }
    [[nodiscard]] bool failed() const { return findings.count > 0; }
};

/// Runs every check for which the dataset has the files and returns all checks in the table's
/// order. `no_scene` is the reason why the subject has no scene. The result does not depend on the
/// number of threads. Returns Cancelled, or BadInput if a large dataset lacks most of its images.
Result<std::vector<CheckResult>> verifyDataset(const Subject& subject, const std::string& no_scene,
                                               const JobContext& job = {});

/// Whether no check found anything.
[[nodiscard]] bool isSound(const std::vector<CheckResult>& results);

}  // namespace dollytrack::verify
