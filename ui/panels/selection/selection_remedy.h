#pragma once

#include "engine/plan/capture_ledger.h"

namespace dollytrack::ui {

/// How far the search is for what would get one object captured.
struct RemedySearch {
    enum class State { NotAsked, Searching, Found, Nothing, Failed };
    State state = State::NotAsked;
    double fraction = 0.0;        // Searching
    LedgerRow row;                // Found and Nothing: what the search knows better than the plan
    bool can_be_applied = false;  // Found: by operations
    std::string error;            // Failed
};

struct RemedyActions {
    bool find = false;
    bool cancel = false;
    bool apply = false;
};

/// Under the reason why an object is not captured, or not well: a button that looks for a way, then
/// the way, and a button that goes it.
RemedyActions drawRemedy(const RemedySearch& search);

}  // namespace dollytrack::ui
