#include "render/frames/mask_rle.h"

#include <algorithm>

namespace dollytrack::render {

std::vector<ObjectMask> objectMasks(int width, int height, std::span<const std::uint16_t> ids) {
    struct Open {
        std::vector<std::uint32_t> counts;
        std::uint32_t end = 0;  // end of its last run
        std::uint32_t area = 0;
        int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
    };
    std::vector<Open> masks(65536);
    std::vector<std::uint16_t> seen;
    std::uint32_t run_start = 0;
    std::uint16_t run_id = width > 0 && height > 0 ? ids[0] : std::uint16_t{0};

    const auto close = [&](std::uint32_t end) {
        if (run_id == 0 || end == run_start) return;
        Open& mask = masks[run_id];
        const int first_x = static_cast<int>(run_start) / height;
        const int last_x = static_cast<int>(end - 1) / height;
        const int first_y = static_cast<int>(run_start) % height;
        const int last_y = static_cast<int>(end - 1) % height;
        // A run across a column's end touches the last and the first row.
        const int low_y = first_x == last_x ? first_y : 0;
        const int high_y = first_x == last_x ? last_y : height - 1;
        if (mask.area == 0) {
            seen.push_back(run_id);
            mask.x0 = first_x;
            mask.y0 = low_y;
        }
        mask.y0 = std::min(mask.y0, low_y);
        mask.x1 = std::max(mask.x1, last_x);
        mask.y1 = std::max(mask.y1, high_y);
        mask.area += end - run_start;
        mask.counts.push_back(run_start - mask.end);
        mask.counts.push_back(end - run_start);
        mask.end = end;
    };
    std::uint32_t place = 0;
    for (int x = 0; x < width; ++x) {
        const std::uint16_t* pixel = ids.data() + x;
        for (int y = 0; y < height; ++y, ++place, pixel += width) {
            if (*pixel == run_id) continue;
            close(place);
            run_id = *pixel;
            run_start = place;
        }
    }
    close(place);

    std::sort(seen.begin(), seen.end());
    std::vector<ObjectMask> result;
    result.reserve(seen.size());
    for (const std::uint16_t id : seen) {
        Open& open = masks[id];
        if (open.end < place) open.counts.push_back(place - open.end);
        result.push_back({id,
                          std::move(open.counts),
                          open.area,
                          {open.x0, open.y0, open.x1 - open.x0 + 1, open.y1 - open.y0 + 1}});
    }
    return result;
}

std::string compressCounts(std::span<const std::uint32_t> counts) {
    std::string text;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        // From the fourth count on, COCO stores differences to the count before the previous one,
        // because adjacent columns are similar.
        std::int64_t value = counts[i];
        if (i > 2) value -= counts[i - 2];
        bool more = true;
        while (more) {
            auto group = static_cast<unsigned>(value & 0x1f);
            value >>= 5;
            more = (group & 0x10U) != 0U ? value != -1 : value != 0;
            if (more) group |= 0x20U;
            text += static_cast<char>(group + 48U);
        }
    }
    return text;
}

std::vector<std::uint32_t> decompressCounts(std::string_view text) {
    std::vector<std::uint32_t> counts;
    std::size_t at = 0;
    while (at < text.size()) {
        std::int64_t value = 0;
        unsigned shift = 0;
        bool more = true;
        while (more) {
            if (at == text.size() || shift > 35) return {};
            const int group = text[at++] - 48;
            if (group < 0 || group > 63) return {};
            value |= static_cast<std::int64_t>(group & 0x1f) << shift;
            shift += 5;
            more = (group & 0x20) != 0;
            if (!more && (group & 0x10) != 0) value |= -(std::int64_t{1} << shift);
        }
        if (counts.size() > 2) value += counts[counts.size() - 2];
        if (value < 0 || value > 0xffffffffLL) return {};
        counts.push_back(static_cast<std::uint32_t>(value));
    }
    return counts;
}

}  // namespace dollytrack::render
