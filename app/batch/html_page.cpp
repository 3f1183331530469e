#include "app/batch/html_page.h"

#include "app/batch/markup.h"

#include <fmt/format.h>

namespace dollytrack::batch {
namespace {

constexpr const char* kStyle = R"(
body { font: 14px/1.45 "Inter", "DejaVu Sans", sans-serif; margin: 2em; color: #222; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
table { border-collapse: collapse; } th, td { padding: 3px 9px; text-align: right; }
th { background: #f0f1f3; position: sticky; top: 0; cursor: pointer; font-weight: 600; }
td:nth-child(2), td:nth-child(3), th:nth-child(2), th:nth-child(3) { text-align: left; }
tr { border-bottom: 1px solid #e4e5e8; } pre { background: #f6f6f7; padding: 8px; overflow: auto; }
.good { color: #17713a; } .bad { color: #b3261e; } .open { color: #8a6100; }
figure { display: inline-block; margin: 6px 10px 6px 0; } figure img { height: auto; width: 380px; }
figcaption { font-size: 12px; }
@media (prefers-color-scheme: dark) { body { background: #1b1c1f; color: #ddd; }
 th, pre { background: #26282c; } tr { border-color: #34363b; } a { color: #8ab4f8; }
 .good { color: #6cc58a; } .bad { color: #ff8a80; } .open { color: #e0b45c; } }
)";

// Sorts the table by the clicked column; numbers by value.
constexpr const char* kScript = R"(
document.querySelectorAll("table.sorted th").forEach(head => {
  let up = false;
  head.onclick = () => {
    up = !up;
    const column = head.cellIndex;
    const body = head.closest("table").tBodies[0];
    const key = row => row.cells[column].dataset.value ?? row.cells[column].textContent;
    [...body.rows].sort((a, b) => {
      const x = key(a), y = key(b);
      const order = x !== "" && y !== "" && !isNaN(x) && !isNaN(y)
        ? x - y : x.localeCompare(y, undefined, {numeric: true});
      return up ? order : -order;
    }).forEach(row => body.append(row));
  };
});
)";

}  // namespace

std::string htmlPage(std::string_view title, std::string_view body) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>\n"
        "<style>{}</style></head><body>\n{}<script>{}</script>\n</body></html>\n",
        asMarkup(title), kStyle, body, kScript);
}

}  // namespace dollytrack::batch
