#include "app/statistics/page_text.h"

#include "app/batch/markup.h"
#include "engine/core/clean_text.h"

namespace dollytrack::statistics {

std::string shownName(std::string_view name, std::size_t most_bytes) {
    std::string clean = cleanText(name);
    if (clean.size() > most_bytes) {
        std::size_t end = most_bytes;
        // Not within a UTF-8 sequence.
        while (end > 0 && (static_cast<unsigned char>(clean[end]) & 0xC0U) == 0x80U) --end;
        clean = clean.substr(0, end) + "…";
    }
    return batch::asMarkup(clean);
}

}  // namespace dollytrack::statistics
