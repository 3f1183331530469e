#pragma once

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// A self-contained HTML page. Clicking a column's head sorts tables of class "sorted". `title` is
/// plain text, `body` is HTML.
[[nodiscard]] std::string htmlPage(std::string_view title, std::string_view body);

}  // namespace dollytrack::batch
