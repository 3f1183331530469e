#include "render/verify/read/number_table.h"

#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

namespace dollytrack::verify {
namespace {

std::vector<std::string> fieldsOf(std::string_view line) {
    std::vector<std::string> fields;
    std::size_t begin = 0;
    while (true) {
        const std::size_t end = line.find(',', begin);
        fields.emplace_back(line.substr(begin, end - begin));
        if (end == std::string_view::npos) return fields;
        begin = end + 1;
    }
}

}  // namespace

Result<NumberTable> NumberTable::read(const std::filesystem::path& path) {
    const Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(text.error());
    NumberTable table;
    int number = 0;
    std::size_t width = 0;
    for (const std::string_view line : splitLines(*text)) {
        std::vector<std::string> fields = fieldsOf(line);
        if (++number == 1) {
            width = fields.size();
            for (std::size_t i = 0; i < width; ++i) {
                if (table.columns_.emplace(fields[i], i).second) continue;
                return fail(ErrorCode::BadInput,
                            fmt::format("The column \"{}\" occurs twice.", fields[i]),
                            placeOf(path, number));
            }
            continue;
        }
        if (fields.size() != width) {
            return fail(
                ErrorCode::BadInput,
                fmt::format("There are {} values for {} column names.", fields.size(), width),
                placeOf(path, number));
        }
        table.rows_.push_back(std::move(fields));
    }
    return table;
}

std::optional<double> NumberTable::number(std::size_t row, const std::string& column) const {
    const auto at = columns_.find(column);
    if (at == columns_.end()) return std::nullopt;
    const Result<double> value = parseNumber(rows_[row][at->second], {}, 0);
    return value ? std::optional(*value) : std::nullopt;
}

}  // namespace dollytrack::verify
