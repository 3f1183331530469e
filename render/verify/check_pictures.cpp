#include "render/verify/check_list.h"
#include "render/verify/picture_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace dollytrack::verify {
namespace {

constexpr std::size_t kFewest = 200;  // border pixels to judge a picture by
constexpr int kAside = 6;             // px
// Sound pictures of furnished rooms have 2 and more, those of other frames most often 0 to 0.9.
constexpr double kLeastRatio = 1.0;
constexpr double kLeastChange = 8.0;  // of 255: what is fainter proves nothing

/// How the colour changes along the whole border of two objects. Signed changes are summed, so that
/// noise and patterns cancel out and what tells the two apart is left.
struct Border {
    std::array<double, 3> sum = {};
    std::array<double, 3> squares = {};
    double count = 0.0;

    void add(const std::uint8_t* from, const std::uint8_t* to) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double change = static_cast<double>(to[c]) - from[c];
            sum[c] += change;
            squares[c] += change * change;
        }
        count += 1.0;
    }
    /// The change beyond what chance may have made: two standard deviations of the sum.
    [[nodiscard]] double beyondChance() const {
        double most = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double spread = std::max(0.0, squares[c] - sum[c] * sum[c] / count);
            most = std::max(most, std::abs(sum[c]) - 2.0 * std::sqrt(spread));
        }
        return most;
    }
};

struct Change {
    double mean = 0.0;      // of 255
    std::size_t count = 0;  // border pixels
};

/// The change of colour at the borders of what the ids show, looked up so far aside; a pixel beyond
/// either side of a border, as those along it are smoothed.
Change changeAtBorders(const Image8& picture, const Image16& ids, bool of_things_alone, int aside_x,
                       int aside_y) {
    std::map<std::pair<int, int>, Border> borders;
    std::size_t count = 0;
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1)}) {
        for (int y = dy; y + 2 * dy < ids.height; ++y) {
            for (int x = dx; x + 2 * dx < ids.width; ++x) {
                const int a = ids.at(x, y);
                const int b = ids.at(x + dx, y + dy);
                if (a == b || (of_things_alone && (a == 0 || b == 0))) continue;
                const int from_x = x - dx + aside_x, from_y = y - dy + aside_y;
                const int to_x = x + 2 * dx + aside_x, to_y = y + 2 * dy + aside_y;
                if (!picture.holds(from_x, from_y) || !picture.holds(to_x, to_y)) continue;
                const std::uint8_t* from = picture.pixel(from_x, from_y);
                const std::uint8_t* to = picture.pixel(to_x, to_y);
                if (a > b) std::swap(from, to);
                borders[std::minmax(a, b)].add(from, to);
                ++count;
            }
        }
    }
    double sum = 0.0;
    for (const auto& [ids_of_two, border] : borders) sum += border.beyondChance();
    return {sum / static_cast<double>(std::max<std::size_t>(count, 1)), count};
}

/// Whether all of it has one colour.
bool isBlank(const Image8& picture) {
    const std::size_t pixels = picture.values.size() / 3;
    for (std::size_t i = 1; i < pixels; ++i) {
        if (!std::equal(picture.values.begin(), picture.values.begin() + 3,
                        picture.values.begin() + static_cast<std::ptrdiff_t>(3 * i))) {
            return false;
        }
    }
    return true;
}

/// Colours change more at the borders of what the picture shows than beside them.
void checkPicture(FrameImages& images, Findings& findings) {
    const Image8* picture = images.image8("rgb");
    const Image16* ids = images.image16("instance");
    if (!picture || !ids) return;
    const std::string wrong = wrongEdges(*picture, *ids, false, kLeastRatio);
    if (wrong.empty()) return;
    findings.add({imageFile("rgb", images.frame()),
                  images.frame(),
                  {},
                  wrong,
                  "edges where the objects of this frame meet"});
}

}  // namespace

std::string wrongEdges(const Image8& picture, const Image16& ids, bool of_things_alone,
                       double least_ratio) {
    const Change here = changeAtBorders(picture, ids, of_things_alone, 0, 0);
    if (here.count < kFewest) return {};
    double aside = 0.0;
    for (const int x : {-kAside, kAside}) {
        for (const int y : {-kAside, kAside}) {
            aside = std::max(aside, changeAtBorders(picture, ids, of_things_alone, x, y).mean);
        }
    }
    const bool proves = std::max(here.mean, aside) >= kLeastChange || isBlank(picture);
    if (!proves || here.mean > least_ratio * aside) return {};
    return fmt::format(
        "where objects meet in the frame's instance image colours change by {:.1f} "
        "of 255, {} px beside by {:.1f}",
        here.mean, kAside, aside);
}

CheckWork beginPictures(const Subject& /*subject*/, Findings& /*findings*/) {
    return {checkPicture, {}};
}

}  // namespace dollytrack::verify
