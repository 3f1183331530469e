#pragma once

#include "engine/plan/capture_ledger.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// The capture ledger for a person: one object a row, those not captured first, then those not
/// captured well; below each of these the reason and what would help, wrapped to `width` columns
/// (0: not at all).
std::string ledgerTable(const Scene& scene, std::vector<LedgerRow> ledger, std::size_t width);

}  // namespace dollytrack::cli
