#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack::ui {

/// One document operation (engine/document/operation.h) requested through a widget.
struct EditRequest {
    nlohmann::json operation;  // null: no request
    std::string merge_key;     // consecutive equal keys become one undo step (a drag)
    bool ends_merge = false;   // the drag has ended; may be set without an operation

    [[nodiscard]] bool asks() const { return !operation.is_null(); }
};

}  // namespace dollytrack::ui
