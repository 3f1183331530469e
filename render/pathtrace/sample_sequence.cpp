#include "render/pathtrace/sample_sequence.h"

namespace dollytrack::render {
namespace {

/// Mixes every input bit into all output bits (Wellons, Hash Function Prospector: lowbias32).
std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    return x ^ (x >> 16U);
}

std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    return hash(a ^ (hash(b) + 0x9e3779b9U + (a << 6U) + (a >> 2U)));
}

std::uint32_t reversed(std::uint32_t x) {
    x = (x >> 16U) | (x << 16U);
    x = ((x & 0x00ff00ffU) << 8U) | ((x & 0xff00ff00U) >> 8U);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x & 0xf0f0f0f0U) >> 4U);
    x = ((x & 0x33333333U) << 2U) | ((x & 0xccccccccU) >> 2U);
    return ((x & 0x55555555U) << 1U) | ((x & 0xaaaaaaaaU) >> 1U);
}

/// Owen scrambling: each bit is flipped by a hash of the bits above it.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed(x);
    x += seed;
    x ^= x * 0x6c50b47cU;
    x ^= x * 0xb82f1e52U;
    x ^= x * 0xc7afe638U;
    x ^= x * 0x8d22f6e6U;
    return reversed(x);
}

/// Second dimension of the Sobol sequence; the first is the index with its bits reversed.
std::uint32_t sobolSecond(std::uint32_t index) {
    std::uint32_t value = 0;
    for (std::uint32_t direction = 0x80000000U; index != 0; index >>= 1U) {
        if ((index & 1U) != 0) value ^= direction;
        direction ^= direction >> 1U;
    }
    return value;
}

double unit(std::uint32_t bits) {
    return bits * 0x1p-32;
}

}  // namespace

SampleSequence::SampleSequence(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample)
    : pixel_seed_(hash(hash(seed), pixel)), sample_(sample) {}

double SampleSequence::next() {
    const std::uint32_t seed = hash(pixel_seed_, dimension_++);
    return unit(scrambled(reversed(scrambled(sample_, seed)), hash(seed, 1)));
}

std::array<double, 2> SampleSequence::nextPair() {
    const std::uint32_t seed = hash(pixel_seed_, dimension_);
    dimension_ += 2;
    const std::uint32_t index = scrambled(sample_, seed);
    return {unit(scrambled(reversed(index), hash(seed, 1))),
            unit(scrambled(sobolSecond(index), hash(seed, 2)))};
}

}  // namespace dollytrack::render
