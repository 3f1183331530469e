#include "render/verify/read/object_colours.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr double kLeastKnown = 0.3;   // least share of cells with a known object
constexpr double kFewestCells = 0.5;  // of a known object

}  // namespace

SmallFrame::SmallFrame(const Image8& picture, const Image16& frame_ids) {
    std::size_t cell = 0;
    for (int row = 0; row < kRows; ++row) {
        const int y0 = row * picture.height / kRows;
        const int y1 = std::max(y0 + 1, (row + 1) * picture.height / kRows);
        for (int column = 0; column < kColumns; ++column, ++cell) {
            const int x0 = column * picture.width / kColumns;
            const int x1 = std::max(x0 + 1, (column + 1) * picture.width / kColumns);
            std::array<int, 3> sum = {};
            for (int y = y0; y < y1; ++y) {
                for (int x = x0; x < x1; ++x) {
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.pixel(x, y)[c];
                }
            }
            for (std::size_t c = 0; c < 3; ++c) {
                colours[cell][c] = static_cast<std::uint8_t>(sum[c] / ((x1 - x0) * (y1 - y0)));
            }
            ids[cell] = frame_ids.at((x0 + x1 - 1) / 2, (y0 + y1 - 1) / 2);
        }
    }
}

std::map<std::uint16_t, ObjectColours::Sum> ObjectColours::sumsOf(const SmallFrame& frame) {
    std::map<std::uint16_t, Sum> sums;
    for (std::size_t i = 0; i < SmallFrame::kCells; ++i) {
        Sum& sum = sums[frame.ids[i]];
        for (std::size_t c = 0; c < 3; ++c) sum.colour[c] += frame.colours[i][c];
        sum.count += 1.0;
    }
    return sums;
}

void ObjectColours::add(const SmallFrame& frame) {
    for (const auto& [id, sum] : sumsOf(frame)) {
        Sum& all = all_[id];
        for (std::size_t c = 0; c < 3; ++c) all.colour[c] += sum.colour[c];
        all.count += sum.count;
    }
}

template <class Ids>
std::map<std::uint16_t, ObjectColours::Sum> ObjectColours::sumsElsewhere(const SmallFrame& without,
                                                                         const Ids& ids) const {
    const std::map<std::uint16_t, Sum> own = sumsOf(without);
    std::map<std::uint16_t, Sum> elsewhere;
    for (const std::uint16_t id : ids) {
        const auto [at, is_new] = elsewhere.try_emplace(id);
        if (!is_new) continue;
        const auto all = all_.find(id);
        if (all != all_.end()) at->second = all->second;
        const auto here = own.find(id);
        if (here == own.end()) continue;
        for (std::size_t c = 0; c < 3; ++c) at->second.colour[c] -= here->second.colour[c];
        at->second.count -= here->second.count;
    }
    return elsewhere;
}

std::map<std::uint16_t, ObjectColours::Mean> ObjectColours::meansElsewhere(
    const SmallFrame& frame) const {
    std::map<std::uint16_t, Mean> means;
    for (const auto& [id, sum] : sumsElsewhere(frame, frame.ids)) {
        if (sum.count < kFewestCells) continue;
        Mean& mean = means[id];
        for (std::size_t c = 0; c < 3; ++c) mean[c] = sum.colour[c] / sum.count;
    }
    return means;
}

double ObjectColours::distance(const SmallFrame& picture, const SmallFrame& labels) const {
    std::map<std::uint16_t, Sum> elsewhere = sumsElsewhere(picture, labels.ids);
    double sum = 0.0;
    std::size_t known = 0;
    for (std::size_t i = 0; i < SmallFrame::kCells; ++i) {
        const Sum& mean = elsewhere[labels.ids[i]];
        if (mean.count < kFewestCells) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            sum += std::abs(picture.colours[i][c] - mean.colour[c] / mean.count);
        }
        ++known;
    }
    if (static_cast<double>(known) < kLeastKnown * static_cast<double>(SmallFrame::kCells))
        return -1.0;
    return sum / (3.0 * static_cast<double>(known));
}

}  // namespace dollytrack::verify
