#pragma once

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// A page that needs no other file. Tables of the class "sorted" are sorted by the column whose
/// head is clicked. `title` is plain text, `body` is markup.
[[nodiscard]] std::string htmlPage(std::string_view title, std::string_view body);

}  // namespace dollytrack::batch
