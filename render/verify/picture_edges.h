#pragma once

#include "render/verify/read/image_files.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// Where two objects meet in an instance image: each place is the left or upper pixel of the two.
struct Outlines {
    std::vector<std::array<int, 2>> across;  // beside each other
    std::vector<std::array<int, 2>> down;    // below each other
    int width = 0;                           // px, of the image
    int height = 0;

    [[nodiscard]] std::size_t count() const { return across.size() + down.size(); }
};

/// `of_things_alone` leaves borders with nothing (id 0) out.
Outlines outlinesOf(const Image16& ids, bool of_things_alone);
/// Those of the image mirrored.
Outlines mirrored(const Outlines& outlines, bool left_right, bool upside_down);

/// Fewer places than this judge no picture.
constexpr std::size_t kFewestPlaces = 200;

/// How well outlines explain a picture.
struct Fit {
    double rank = 0.5;    // mean share of the picture that changes less than these places: 0.5 by
                          // chance, near 1 where all of them are edges of the picture
    double strong = 0.0;  // share of these places where the picture changes by kEdge and more
    std::size_t count = 0;
};

/// How much a picture changes from pixel to pixel. Its ranks are what counts, so that dark and
/// faint pictures are judged as well as others.
class ChangeMap {
  public:
    static constexpr int kEdge = 8;  // of 255

    explicit ChangeMap(const Image8& picture);

    /// With the outlines moved by so many pixels.
    [[nodiscard]] Fit fit(const Outlines& outlines, int dx = 0, int dy = 0) const;
    /// The share of the picture that changes by kEdge and more.
    [[nodiscard]] double structure() const { return structure_; }
    /// Whether all of the picture has one colour.
    [[nodiscard]] bool blank() const { return blank_; }

  private:
    struct Direction {
        std::vector<std::uint8_t> change;
        std::array<float, 256> rank = {};  // of a change
    };
    [[nodiscard]] static Direction lookAlong(const Image8& picture, int dx, int dy);

    int width_ = 0;
    int height_ = 0;
    Direction across_, down_;
    double structure_ = 0.0;
    bool blank_ = true;
};

/// Whether outlines explain a picture so much better than its own do that they are not beaten by
/// chance: a thin line beside a faint border can do that to a few places, but not to most.
bool explainsBetter(const Fit& other, const Fit& own);

/// What the picture says of the outlines of its own frame.
struct OwnFit {
    Fit own;
    double best = 0.0;      // rank, of these outlines mirrored and moved as well
    std::string elsewhere;  // what explains the picture better: "mirrored left to right"; or empty
    Fit fit_elsewhere;
};
OwnFit judgeByOwn(const ChangeMap& picture, const Outlines& outlines);

/// Whether all of a picture has one colour.
bool isBlank(const Image8& picture);
constexpr const char* kBlank = "all of it has one colour";

/// "where objects meet ...": for findings.
std::string textOf(const Fit& own);
std::string textOf(const OwnFit& judged);

}  // namespace dollytrack::verify
