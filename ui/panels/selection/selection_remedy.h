#pragma once

#include "engine/plan/capture_ledger.h"

namespace dollytrack::ui {

/// State of the search for a remedy: a change after which an object is captured.
struct RemedySearch {
    enum class State { NotAsked, Searching, Found, Nothing, Failed };
    State state = State::NotAsked;
    double fraction = 0.0;        // Searching
    LedgerRow row;                // Found and Nothing: the search's more detailed ledger row
    bool can_be_applied = false;  // Found: the remedy can be expressed as edit operations
    std::string error;            // Failed
};

struct RemedyActions {
    bool find = false;
    bool cancel = false;
    bool apply = false;
    bool select_object = false;  // the object that must be moved
};

/// Draws, below the reason why an object is not (well) captured, a button that starts the search,
/// its progress, the remedy found, and a button that applies it.
RemedyActions drawRemedy(const RemedySearch& search);

}  // namespace dollytrack::ui
