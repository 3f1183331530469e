#pragma once

#include "render/pathtrace/layered_image.h"

namespace dollytrack::render {

/// The mean over an image's samples with less noise, see averaged(). Each layer becomes, in small
/// windows, a linear function of the normals and positions of its surfaces (first-order regression,
/// Bitterli et al., Nonlinearly weighted first-order regression for denoising Monte Carlo
/// renderings, 2016). Pixels count by how similar their surfaces are, and their light in relation
/// to the noise. Diffuse light is divided by the reflectance before, so that textures stay sharp.
/// Results do not depend on the number of threads. `image` needs two sets with the same number of
/// samples.
[[nodiscard]] PictureLayers denoised(const LayeredImage& image, float scale);

/// Rows above and below one that its denoised values depend on. Parts of an image whose first row
/// is a multiple of a quarter of it are denoised as in the whole image.
constexpr int kDenoisedRows = 24;

}  // namespace dollytrack::render
