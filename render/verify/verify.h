#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/verify/check.h"

#include <string>
#include <vector>

namespace dollytrack::verify {

/// What became of one check.
struct CheckResult {
    const Check* check = nullptr;
    std::string skipped;  // why it was not made; empty when it was
    Findings findings;

    [[nodiscard]] bool passed() const { return skipped.empty() && findings.count == 0; }
    [[nodiscard]] bool failed() const { return findings.count > 0; }
};

/// Makes every check that the dataset has the files for; all of them are in the result, in the
/// table's order. `no_scene` says why the subject has no scene. The result does not depend on the
/// number of threads. Errors: Cancelled; BadInput when a large dataset lacks most of its images.
Result<std::vector<CheckResult>> verifyDataset(const Subject& subject, const std::string& no_scene,
                                               const JobContext& job = {});

/// Whether nothing was found.
[[nodiscard]] bool isSound(const std::vector<CheckResult>& results);

}  // namespace dollytrack::verify
