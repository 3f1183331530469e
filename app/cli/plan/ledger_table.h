#pragma once

#include "engine/plan/capture_ledger.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// The capture ledger as text: one object per row, first those not captured, then those not well
/// captured, each with the reason and the remedy below, wrapped to `width` columns (0: not
/// wrapped).
std::string ledgerTable(const Scene& scene, std::vector<LedgerRow> ledger, std::size_t width);

}  // namespace dollytrack::cli
