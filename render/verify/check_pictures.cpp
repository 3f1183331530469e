#include "render/verify/check_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace dollytrack::verify {
namespace {

constexpr std::size_t kFewest = 200;  // borders between objects, px, to judge a picture by
constexpr int kAside = 5;             // px
// Sound pictures of furnished rooms have 2 and more, those of other frames most often 0.2 to 1.3.
constexpr double kLeastRatio = 1.4;

/// How much the colour changes between neighbours along one axis, at most one pixel beside.
class Steps {
  public:
    Steps(const Image8& picture, int dx, int dy)
        : width_(picture.width - dx), height_(picture.height - dy), dx_(dx), dy_(dy) {
        std::vector<std::uint8_t> steps;
        steps.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const std::uint8_t* a = picture.pixel(x, y);
                const std::uint8_t* b = picture.pixel(x + dx, y + dy);
                int most = 0;
                for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
                steps.push_back(static_cast<std::uint8_t>(most));
            }
        }
        values_ = steps;
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                for (const int side : {-1, 1}) {
                    const int near_x = x + side * dx;
                    const int near_y = y + side * dy;
                    if (!holds(near_x, near_y)) continue;
                    values_[at(x, y)] = std::max(values_[at(x, y)], steps[at(near_x, near_y)]);
                }
            }
        }
    }

    struct Sum {
        double steps = 0.0;
        std::size_t count = 0;
    };

    /// The steps where the ids change, looked up so far aside.
    [[nodiscard]] Sum atBorders(const Image16& ids, int aside_x, int aside_y) const {
        Sum sum;
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                if (*ids.pixel(x, y) == *ids.pixel(x + dx_, y + dy_)) continue;
                if (!holds(x + aside_x, y + aside_y)) continue;
                sum.steps += values_[at(x + aside_x, y + aside_y)];
                ++sum.count;
            }
        }
        return sum;
    }

  private:
    [[nodiscard]] bool holds(int x, int y) const {
        return x >= 0 && y >= 0 && x < width_ && y < height_;
    }
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    int dx_;
    int dy_;
    std::vector<std::uint8_t> values_;
};

/// Colours change more at the borders of what the picture shows than beside them.
void checkPicture(FrameImages& images, Findings& findings) {
    const Image8* picture = images.image8("rgb");
    const Image16* ids = images.image16("instance");
    if (!picture || !ids) return;
    const std::array steps = {Steps(*picture, 1, 0), Steps(*picture, 0, 1)};
    const auto meanAside = [&](int x, int y) {
        Steps::Sum all;
        for (const Steps& along : steps) {
            const Steps::Sum sum = along.atBorders(*ids, x, y);
            all.steps += sum.steps;
            all.count += sum.count;
        }
        return std::pair(all.steps / static_cast<double>(std::max<std::size_t>(all.count, 1)),
                         all.count);
    };
    const auto [here, count] = meanAside(0, 0);
    if (count < kFewest) return;
    double aside = 0.0;
    for (const auto& [x, y] :
         {std::pair(kAside, kAside), {-kAside, kAside}, {kAside, -kAside}, {-kAside, -kAside}}) {
        aside = std::max(aside, meanAside(x, y).first);
    }
    if (here > kLeastRatio * aside) return;
    findings.add({imageFile("rgb", images.frame()),
                  images.frame(),
                  {},
                  fmt::format("where objects meet in instance/{:06}.png colours change by {:.1f} "
                              "of 255, {} px beside by {:.1f}",
                              images.frame(), here, kAside, aside),
                  "edges where the objects of this frame meet"});
}

}  // namespace

CheckWork beginPictures(const Subject& /*subject*/, Findings& /*findings*/) {
    return {checkPicture, {}};
}

}  // namespace dollytrack::verify
