#include "app/gather/sources/scene_split.h"

#include "engine/core/disjoint_sets.h"
#include "engine/core/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace dollytrack::gather {
namespace {

constexpr std::uint64_t kTries = 200;  // number of random orders of the scenes

using Assignment = std::vector<PartIndex>;  // part of each scene

/// The numbers of a text such as "80/10/10"; empty if it has another form.
std::vector<double> numbersOf(const std::string& text) {
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('/', begin), text.size());
        double number = 0.0;
        const auto read = std::from_chars(text.data() + begin, text.data() + end, number);
        if (read.ec != std::errc() || read.ptr != text.data() + end) return {};
        numbers.push_back(number);
        begin = end + 1;
    }
    return numbers;
}

/// Assigns the scenes in order, each to the part that lacks most frames; the last ones to parts
/// that would be empty.
Assignment assign(const std::vector<double>& frames, const std::vector<std::size_t>& order,
                  const std::array<double, kParts.size()>& shares) {
    const double all = std::accumulate(frames.begin(), frames.end(), 0.0);
    std::array<double, kParts.size()> lacking = {};
    std::array<bool, kParts.size()> is_empty = {};
    for (PartIndex part = 0; part < kParts.size(); ++part) {
        lacking[part] = all * shares[part];
        is_empty[part] = shares[part] > 0.0;
    }
    Assignment parts(frames.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t empty = std::ranges::count(is_empty, true);
        const bool only_empty = order.size() - i <= empty;
        std::optional<PartIndex> best;
        for (PartIndex part = 0; part < kParts.size(); ++part) {
            if (shares[part] <= 0.0 || (only_empty && !is_empty[part])) continue;
            if (!best || lacking[part] > lacking[*best]) best = part;
        }
        parts[order[i]] = best.value_or(0);
        lacking[parts[order[i]]] -= frames[order[i]];
        is_empty[parts[order[i]]] = false;
    }
    return parts;
}

/// The number of frames that deviate from the shares.
double imbalance(const std::vector<double>& frames, const Assignment& parts,
                 const std::array<double, kParts.size()>& shares) {
    const double all = std::accumulate(frames.begin(), frames.end(), 0.0);
    std::array<double, kParts.size()> held = {};
    for (std::size_t i = 0; i < frames.size(); ++i) held[parts[i]] += frames[i];
    double sum = 0.0;
    for (PartIndex part = 0; part < kParts.size(); ++part) {
        sum += std::abs(held[part] - all * shares[part]);
    }
    return sum;
}

}  // namespace

bool looksLikeShares(const std::string& text) {
    return text.find('/') != std::string::npos && !numbersOf(text).empty();
}

Result<SplitOrder> parseSplit(const std::string& kind, const std::string& shares) {
    SplitOrder order;
    order.shares[0] = 1.0;
    if (kind == "none" && shares.empty()) return order;
    if (kind != "by-room") {
        return fail(ErrorCode::Usage, "A split is 'none' or 'by-room 80/10/10'.", "--split");
    }
    const std::vector<double> numbers = numbersOf(shares.empty() ? "80/10/10" : shares);
    const bool positive = std::ranges::all_of(numbers, [](double n) { return n >= 0.0; });
    const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
    if (numbers.size() < 2 || numbers.size() > kParts.size() || !positive ||
        !(numbers.front() > 0.0) || !std::isfinite(sum)) {
        return fail(ErrorCode::Usage,
                    "The shares are those of train, val and test, as in 80/10/10, and that of "
                    "train must be above 0.",
                    fmt::format("--split by-room {}", shares));
    }
    constexpr double kSlip = 0.001;  // tolerance for rounded shares, as in 0.333/0.333/0.333
    if (std::abs(sum - 100.0) > 100.0 * kSlip && std::abs(sum - 1.0) > 2.0 * kSlip) {
        return fail(ErrorCode::Usage,
                    fmt::format("The shares add up to {:g}, and must add up to 100 or 1, as in "
                                "80/10/10.",
                                sum),
                    fmt::format("--split by-room {}", shares));
    }
    order.by_room = true;
    order.shares = {};
    for (std::size_t i = 0; i < numbers.size(); ++i) order.shares[i] = numbers[i] / sum;
    return order;
}

std::vector<std::size_t> scenesOf(std::span<const Source> sources) {
    DisjointSets sets(sources.size());
    std::map<std::string, std::size_t> first;  // first scene with each hash
    for (std::size_t i = 0; i < sources.size(); ++i) {
        for (const std::string* hash : {&sources[i].scene_sha256, &sources[i].geometry_sha256}) {
            if (hash->empty()) continue;
            const std::size_t other = first.emplace(*hash, i).first->second;
            sets.join(i, other);
        }
    }
    std::map<std::size_t, std::size_t> numbers;  // group number by root
    std::vector<std::size_t> scenes;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        scenes.push_back(numbers.emplace(sets.find(i), numbers.size()).first->second);
    }
    return scenes;
}

Result<std::vector<PartIndex>> splitByScene(std::span<const Source> sources,
                                            const SplitOrder& order) {
    if (!order.by_room) return std::vector<PartIndex>(sources.size(), 0);
    const std::vector<std::size_t> scenes = scenesOf(sources);
    const std::size_t count = scenes.empty() ? 0 : *std::ranges::max_element(scenes) + 1;
    const auto parts = static_cast<std::size_t>(
        std::ranges::count_if(order.shares, [](double share) { return share > 0.0; }));
    if (count < parts) {
        return fail(ErrorCode::Usage,
                    fmt::format("{} scene{} cannot be split into {} parts without a room in two "
                                "parts; gather more scenes, or give --split none.",
                                count, count == 1 ? "" : "s", parts),
                    "--split");
    }
    std::vector<double> frames(count);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        frames[scenes[i]] += static_cast<double>(sources[i].frames);
    }
    std::vector<std::size_t> shuffled(count);
    std::iota(shuffled.begin(), shuffled.end(), std::size_t{0});
    Assignment best;
    double least = 0.0;
    for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
        Random random(order.seed, attempt);
        for (std::size_t i = count; i > 1; --i) {
            std::swap(shuffled[i - 1], shuffled[random.below(static_cast<std::uint32_t>(i))]);
        }
        Assignment candidate = assign(frames, shuffled, order.shares);
        const double amount = imbalance(frames, candidate, order.shares);
        if (!best.empty() && amount >= least) continue;
        best = std::move(candidate);
        least = amount;
    }
    std::vector<PartIndex> chosen;
    for (const std::size_t scene : scenes) chosen.push_back(best[scene]);
    return chosen;
}

}  // namespace dollytrack::gather
