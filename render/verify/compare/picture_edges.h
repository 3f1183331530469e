#pragma once

#include "render/verify/read/image_files.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Object borders in an instance image. Each entry is the left or upper pixel of a pair of
/// neighbours with different ids.
struct Outlines {
    std::vector<std::array<int, 2>> across;  // horizontal pairs
    std::vector<std::array<int, 2>> down;    // vertical pairs
    int width = 0;                           // px, of the image
    int height = 0;

    [[nodiscard]] std::size_t count() const { return across.size() + down.size(); }
};

/// `objects_only` leaves out borders to pixels without object (id 0).
Outlines outlinesOf(const Image16& ids, bool objects_only);
/// The borders between neighbouring objects for whose ids `counts` is true.
Outlines outlinesOf(const Image16& ids, const std::function<bool(int id, int other)>& counts);
/// The outlines of the mirrored image.
Outlines mirrored(const Outlines& outlines, bool left_right, bool upside_down);

/// Images with fewer border pixels are not compared.
constexpr std::size_t kFewestPlaces = 200;

/// How well outlines agree with an image's edges.
struct Fit {
    double rank = 0.5;    // mean percentile rank (0 to 1) of the image's change at these pixels:
                          // 0.5 by chance, near 1 if all of them are edges
    double strong = 0.0;  // share of these pixels where the image changes by kEdge or more
    std::size_t count = 0;
};

/// Magnitude of an image's changes between neighbouring pixels. Ranks make dark and low-contrast
/// images comparable.
class GradientMap {
  public:
    static constexpr int kEdge = 8;  // of 255

    explicit GradientMap(const Image8& picture);

    /// The fit of outlines shifted by (dx, dy) px.
    [[nodiscard]] Fit fit(const Outlines& outlines, int dx = 0, int dy = 0) const;
    /// Share of the image that changes by kEdge or more.
    [[nodiscard]] double structure() const { return structure_; }
    /// Whether the whole image has one colour.
    [[nodiscard]] bool blank() const { return blank_; }

  private:
    struct Direction {
        std::vector<std::uint8_t> change;
        std::array<float, 256> rank = {};  // of each change value
    };
    [[nodiscard]] static Direction changesAlong(const Image8& picture, int dx, int dy);

    int width_ = 0;
    int height_ = 0;
    Direction across_, down_;
    double structure_ = 0.0;
    bool blank_ = true;
};

/// Whether the outlines of another frame fit an image so much better than those of its own frame
/// that it cannot be chance. They must explain most pixels better: a few may lie on a thin line
/// beside a border of low contrast.
bool explainsBetter(const Fit& other, const Fit& own);

/// How well the outlines of its own frame fit an image, and whether transformed ones fit better.
struct OutlineAlignment {
    Fit own;
    double best = 0.0;      // best rank, including mirrored and shifted outlines
    std::string elsewhere;  // transform that fits better, for example "mirrored left to right"; or
                            // empty
    Fit fit_elsewhere;
};
OutlineAlignment alignmentOf(const GradientMap& picture, const Outlines& outlines);

/// Whether the whole image has one colour.
bool isBlank(const Image8& picture);
constexpr const char* kBlank = "all of it has one colour";

/// Texts for findings: "where objects meet ...".
std::string textOf(const Fit& own);
std::string textOf(const OutlineAlignment& alignment);

}  // namespace dollytrack::verify
