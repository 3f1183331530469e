#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack::ui {

/// One operation (engine/document/operation.h) that the user asked for with a widget.
struct EditRequest {
    nlohmann::json operation;  // null: nothing was asked
    std::string merge_key;     // of a drag: requests with the same key in a row are one undo step
    bool ends_merge = false;   // the drag is over, with or without a last operation

    [[nodiscard]] bool asks() const { return !operation.is_null(); }
};

}  // namespace dollytrack::ui
