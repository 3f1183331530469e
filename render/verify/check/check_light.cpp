// Compares the layers of path-traced light with each other and with the colour image.
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::verify {
namespace {

/// Largest difference of sums of 16-bit floats, which have 11 binary digits.
double tolerance(double value) {
    return (1.0 + std::abs(value)) / 1024.0;
}

/// The 8-bit value of light, by the tone curve that dataset.json states.
int shownAs(double light) {
    const double above = std::max(light - 0.55, 0.0);
    return encodedSrgb(std::min(light, 0.55) + 0.45 * above / (above + 0.45));
}

/// Checks one channel of one pixel: expected(i) gives what value i of the image must be near to.
template <class Expected>
void compare(FrameImages& images, const char* modality, const ImageF& image, const char* meaning,
             Findings& findings, Expected&& expected) {
    WrongPixels wrong;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const std::size_t i =
                    3 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)) +
                    static_cast<std::size_t>(c);
                const double found = image.values[i];
                const double right = expected(i);
                if (std::abs(found - right) <= tolerance(right)) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("{:.5f} in channel {}", found, c),
                                             fmt::format("{:.5f}, {}", right, meaning)};
                });
            }
        }
    }
    wrong.report(imageFile(modality, images.frame()), images.frame(), findings);
}

void comparePicture(FrameImages& images, const Image8& rgb, const ImageF& hdr, Findings& findings) {
    WrongPixels wrong;
    for (int y = 0; y < rgb.height; ++y) {
        for (int x = 0; x < rgb.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const int found = rgb.pixel(x, y)[c];
                const double light = hdr.pixel(x, y)[c];
                if (std::abs(found - shownAs(light)) <= 1) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{
                        fmt::format("{} in channel {}", found, c),
                        fmt::format("{}, by hdr and the tone curve", shownAs(light))};
                });
            }
        }
    }
    wrong.report(imageFile("rgb", images.frame()), images.frame(), findings);
}

}  // namespace

CheckWork beginLight(const Subject& /*subject*/, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [](FrameImages& images, Findings& findings) {
        const ImageF* hdr = images.imageF("hdr");
        const ImageF* reflectance = images.imageF("diffuse_reflectance");
        const ImageF* illumination = images.imageF("diffuse_illumination");
        const ImageF* residual = images.imageF("residual");
        const ImageF* direct = images.imageF("direct_illumination");
        const ImageF* indirect = images.imageF("indirect_illumination");
        if (hdr && reflectance && illumination && residual) {
            compare(images, "hdr", *hdr, "the sum of its layers", findings, [&](std::size_t i) {
                return double{reflectance->values[i]} * illumination->values[i] +
                       residual->values[i];
            });
        }
        if (illumination && direct && indirect) {
            compare(images, "diffuse_illumination", *illumination, "direct and indirect", findings,
                    [&](std::size_t i) { return double{direct->values[i]} + indirect->values[i]; });
        }
        if (const Image8* rgb = images.image8("rgb"); rgb && hdr) {
            comparePicture(images, *rgb, *hdr, findings);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
