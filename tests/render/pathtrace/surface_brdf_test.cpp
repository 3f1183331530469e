#include "render/materials/surface_brdf.h"

#include "render/pathtrace/sample_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack::render::surface_brdf_test {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d wayAt(double cosine, double angle = 0.3) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// The share of uniform light from all directions that is reflected along `out`, by the BRDF's own
/// samples.
double albedo(double base, double metallic, double roughness, double cosine) {
    const SurfaceBrdf brdf(Eigen::Vector3f::Constant(static_cast<float>(base)), metallic, roughness,
                           wayAt(cosine));
    constexpr int kCount = 16384;
    double sum = 0.0;
    for (std::uint32_t k = 0; k < kCount; ++k) {
        SampleSequence chance(5, 0, k);
        const double which = chance.next();
        const Eigen::Vector3d in = brdf.sample(which, chance.nextPair());
        const double density = brdf.density(in);
        if (in.z() <= 0.0 || density <= 0.0) continue;
        sum += brdf.value(in).mean() * in.z() / density;
    }
    return sum / kCount;
}

/// Calls visit(direction, solid angle) for the midpoints of a grid over the hemisphere.
template <class Visit>
void overHemisphere(int steps, Visit&& visit) {
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < 2 * steps; ++j) {
            visit(wayAt((i + 0.5) / steps, 2.0 * kPi * (j + 0.5) / (2 * steps)),
                  2.0 * kPi / (2.0 * steps * steps));
        }
    }
}

// White furnace test: a surface that absorbs nothing reflects all light.
TEST(SurfaceBrdf, AWhiteSurfaceKeepsAllLight) {
    for (const double metallic : {0.0, 0.5, 1.0}) {
        for (const double roughness : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
            for (const double cosine : {0.1, 0.3, 0.6, 0.95}) {
                EXPECT_NEAR(albedo(1.0, metallic, roughness, cosine), 1.0, 0.01)
                    << "metallic " << metallic << " roughness " << roughness << " cosine "
                    << cosine;
            }
        }
    }
}

TEST(SurfaceBrdf, AGreySurfaceDoesNot) {
    EXPECT_LT(albedo(0.9, 0.0, 0.8, 0.9), 0.95);
    EXPECT_LT(albedo(0.9, 1.0, 0.8, 0.9), 0.95);
}

// Compares with the same integral without the sampler, and checks the integral of the sampler's
// density.
TEST(SurfaceBrdf, SamplesAndSumsAgree) {
    for (const double roughness : {0.3, 0.6, 1.0}) {
        const SurfaceBrdf brdf({0.7F, 0.7F, 0.7F}, 0.3, roughness, wayAt(0.7));
        double sent = 0.0;
        double density = 0.0;
        overHemisphere(400, [&](const Eigen::Vector3d& in, double solid_angle) {
            sent += brdf.value(in).mean() * in.z() * solid_angle;
            density += brdf.density(in) * solid_angle;
        });
        EXPECT_NEAR(sent, albedo(0.7, 0.3, roughness, 0.7), 0.004) << roughness;
        // Some of the facets' mirror directions lie below the surface.
        EXPECT_LE(density, 1.001);
        EXPECT_GT(density, 0.85);
    }
}

TEST(SurfaceBrdf, ReflectsNothingBelowTheSurface) {
    const SurfaceBrdf brdf(Eigen::Vector3f::Ones(), 0.0, 0.5, wayAt(0.5));
    EXPECT_EQ(brdf.value(-wayAt(0.5)).norm(), 0.0F);
    EXPECT_EQ(brdf.density(-wayAt(0.5)), 0.0);
}

// Each of 64 equal cells of any elementary shape gets one of 64 samples, as for every Sobol
// sequence.
TEST(SampleSequence, FillsThePlaneEvenly) {
    for (const std::uint32_t pixel : {0U, 1U, 77777U}) {
        for (const auto& [across, down] : {std::pair{64, 1}, {16, 4}, {8, 8}, {2, 32}, {1, 64}}) {
            std::set<std::pair<int, int>> cells;
            for (std::uint32_t k = 0; k < 64; ++k) {
                SampleSequence chance(3, pixel, k);
                chance.jumpTo(20);
                const auto [u, v] = chance.nextPair();
                ASSERT_TRUE(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0);
                cells.emplace(static_cast<int>(u * across), static_cast<int>(v * down));
            }
            EXPECT_EQ(cells.size(), 64U) << across << " x " << down;
        }
    }
}

TEST(SampleSequence, DimensionsPixelsAndSeedsAreNotAlike) {
    const auto correlation = [](auto&& a, auto&& b) {
        double sum = 0.0;
        for (std::uint32_t k = 0; k < 4096; ++k) sum += (a(k) - 0.5) * (b(k) - 0.5);
        return 12.0 * sum / 4096;
    };
    const auto of = [](std::uint32_t seed, std::uint32_t pixel, std::uint32_t dimension) {
        return [=](std::uint32_t k) {
            SampleSequence chance(seed, pixel, k);
            chance.jumpTo(dimension);
            return chance.next();
        };
    };
    EXPECT_NEAR(correlation(of(1, 0, 0), of(1, 0, 0)), 1.0, 0.01);  // checks the measure itself
    EXPECT_NEAR(correlation(of(1, 0, 0), of(1, 0, 1)), 0.0, 0.06);
    EXPECT_NEAR(correlation(of(1, 0, 4), of(1, 0, 20)), 0.0, 0.06);
    EXPECT_NEAR(correlation(of(1, 0, 4), of(1, 1, 4)), 0.0, 0.06);
    EXPECT_NEAR(correlation(of(1, 0, 4), of(2, 0, 4)), 0.0, 0.06);
}

}  // namespace
}  // namespace dollytrack::render::surface_brdf_test
