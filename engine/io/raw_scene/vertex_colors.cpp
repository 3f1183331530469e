#include "engine/io/raw_scene/vertex_colors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

namespace dollytrack {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr std::size_t kMostSquares = std::size_t{1} << 20U;  // 2048 x 2048 texels
constexpr std::uint32_t kInvalid = 0xFFFFFFFFU;

Rgb bytesOf(const Eigen::Vector3f& color) {
    Rgb rgb{};
    for (int c = 0; c < 3; ++c) {
        const float value = std::isfinite(color[c]) ? std::clamp(color[c], 0.0F, 1.0F) : 0.0F;
        rgb[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255.0F * value));
    }
    return rgb;
}

/// Packs the even bits of a number (0, 2, 4 ...) into the lower half: one coordinate of a Z order
/// index.
std::size_t everySecondBit(std::size_t bits) {
    std::size_t result = 0;
    for (unsigned i = 0; i < 16; ++i) result |= ((bits >> (2U * i)) & 1U) << i;
    return result;
}

/// Squares of 2 x 2 texels in Z order, so that the squares of consecutive faces, which mostly lie
/// near each other, are also averaged with each other in smaller versions of the texture.
class SquareLayout {
  public:
    explicit SquareLayout(std::size_t squares) {
        const auto bits =
            static_cast<unsigned>(std::bit_width(std::max<std::size_t>(squares, 1) - 1));
        width_ = std::size_t{2} << ((bits + 1) / 2);
        height_ = std::size_t{2} << (bits / 2);
    }
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }
    [[nodiscard]] static std::size_t left(std::size_t square) { return 2 * everySecondBit(square); }
    [[nodiscard]] static std::size_t top(std::size_t square) {
        return 2 * everySecondBit(square >> 1U);
    }
    /// Texture coordinates of a place in a square, in texels from its upper left corner.
    [[nodiscard]] Eigen::Vector3f uv(std::size_t square, float right, float down) const {
        return {(static_cast<float>(left(square)) + right) / static_cast<float>(width_),
                1.0F - (static_cast<float>(top(square)) + down) / static_cast<float>(height_),
                0.0F};
    }

  private:
    std::size_t width_;  // texels
    std::size_t height_;
};

/// The texels of a square, row by row.
using Texels = std::array<Rgb, 4>;

/// Bilinear filtering between the texels' centres gives the linear interpolation between the
/// vertices.
Texels texelsOf(const std::vector<Rgb>& corners) {
    if (corners.size() == 4) return {corners[0], corners[1], corners[3], corners[2]};
    Texels texels{corners[0], corners[1], corners[2], {}};
    for (std::size_t c = 0; c < 3; ++c) {
        texels[3][c] = static_cast<std::uint8_t>(
            std::clamp(int{corners[1][c]} + corners[2][c] - corners[0][c], 0, 255));
    }
    return texels;
}

Rgb meanOf(const std::vector<Rgb>& corners, unsigned dropped_bits) {
    Rgb mean{};
    for (std::size_t c = 0; c < 3; ++c) {
        std::size_t sum = 0;
        for (const Rgb& corner : corners) sum += corner[c];
        const auto value = static_cast<unsigned>(sum / corners.size());
        mean[c] = static_cast<std::uint8_t>((value >> dropped_bits) << dropped_bits);
    }
    return mean;
}

/// The squares of all faces. Faces of a single colour share the square of that colour.
struct Squares {
    std::vector<Texels> texels;
    std::vector<std::size_t> of_face;
    std::vector<bool> uniform;  // by face: whether it has a single colour
};

/// With `flat`, each face has its mean colour, rounded to 5 bits per channel so that faces share
/// squares. Returns nullopt if there are too many squares.
std::optional<Squares> layOut(const SourceMesh& mesh, std::span<const Rgb> colors, bool flat) {
    Squares squares;
    std::map<Rgb, std::size_t> of_color;
    std::vector<Rgb> corners;
    std::size_t first = 0;
    for (const std::uint32_t size : mesh.face_sizes) {
        corners.clear();
        for (const std::uint32_t v : mesh.face_indices.subspan(first, size)) {
            if (v < colors.size()) corners.push_back(colors[v]);
        }
        first += size;
        if (corners.empty()) corners.push_back({});
        const bool one_color = std::ranges::all_of(
            corners, [&](const Rgb& corner) { return corner == corners.front(); });
        // Faces with invalid vertices have one colour, too; they are dropped later.
        const bool has_square = corners.size() == size && (size == 3 || size == 4);
        const bool uniform = flat || one_color || !has_square;
        std::size_t square = squares.texels.size();
        if (uniform) {
            const Rgb color = meanOf(corners, flat ? 3 : 0);
            const auto [found, is_new] = of_color.try_emplace(color, square);
            square = found->second;
            if (is_new) squares.texels.push_back({color, color, color, color});
        } else {
            squares.texels.push_back(texelsOf(corners));
        }
        if (squares.texels.size() > kMostSquares) return std::nullopt;
        squares.of_face.push_back(square);
        squares.uniform.push_back(uniform);
    }
    return squares;
}

TextureRequest paint(const Squares& squares, const SquareLayout& layout) {
    TextureRequest texture;
    texture.name = "vertex colours";
    texture.embedded_width = static_cast<int>(layout.width());
    texture.embedded_height = static_cast<int>(layout.height());
    texture.embedded.assign(4 * layout.width() * layout.height(), 255);
    for (std::size_t square = 0; square < squares.texels.size(); ++square) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t x = SquareLayout::left(square) + (i & 1U);
            const std::size_t y = SquareLayout::top(square) + (i >> 1U);
            std::ranges::copy(squares.texels[square][i],
                              texture.embedded.begin() +
                                  static_cast<std::ptrdiff_t>(4 * (y * layout.width() + x)));
        }
    }
    return texture;
}

}  // namespace

std::optional<PaintedMesh> paintVertexColors(const SourceMesh& mesh,
                                             std::span<const Eigen::Vector3f> colors) {
    if (colors.empty() || colors.size() != mesh.positions.size()) return std::nullopt;
    std::vector<Rgb> bytes;
    bytes.reserve(colors.size());
    for (const Eigen::Vector3f& color : colors) bytes.push_back(bytesOf(color));
    if (std::ranges::adjacent_find(bytes, std::not_equal_to()) == bytes.end()) return std::nullopt;
    std::optional<Squares> squares = layOut(mesh, bytes, false);
    if (!squares) squares = layOut(mesh, bytes, true);
    if (!squares) return std::nullopt;

    const SquareLayout layout(squares->texels.size());
    PaintedMesh painted;
    painted.texture = paint(*squares, layout);
    const bool has_normals = mesh.normals.size() == mesh.positions.size();
    constexpr std::array<std::array<float, 2>, 4> kQuadrilateral = {
        {{0.5F, 0.5F}, {1.5F, 0.5F}, {1.5F, 1.5F}, {0.5F, 1.5F}}};
    constexpr std::array<std::array<float, 2>, 3> kTriangle = {
        {{0.5F, 0.5F}, {1.5F, 0.5F}, {0.5F, 1.5F}}};
    std::size_t first = 0;
    for (std::size_t face = 0; face < mesh.face_sizes.size(); ++face) {
        const std::size_t size = mesh.face_sizes[face];
        for (std::size_t corner = 0; corner < size; ++corner) {
            const std::uint32_t v = mesh.face_indices[first + corner];
            if (v >= mesh.positions.size()) {
                painted.indices.push_back(kInvalid);
                continue;
            }
            std::array<float, 2> place = {1.0F, 1.0F};
            if (!squares->uniform[face])
                place = size == 3 ? kTriangle[corner] : kQuadrilateral[corner];
            painted.indices.push_back(static_cast<std::uint32_t>(painted.positions.size()));
            painted.positions.push_back(mesh.positions[v]);
            if (has_normals) painted.normals.push_back(mesh.normals[v]);
            painted.uvs.push_back(layout.uv(squares->of_face[face], place[0], place[1]));
        }
        first += size;
    }
    return painted;
}

}  // namespace dollytrack
