#include "render/pathtrace/layered_image.h"

#include "render/light/tone_curve.h"

#include <algorithm>

namespace dollytrack::render {

std::vector<Eigen::Vector3f> meanOf(const LayeredImage& image, Eigen::Vector3f LayeredLight::*layer,
                                    float scale) {
    std::vector<Eigen::Vector3f> mean(image.sets[0].size());
    const float factor = scale / static_cast<float>(std::max(image.samples, 1));
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = factor * (image.total(i).*layer);
    return mean;
}

std::vector<Eigen::Vector3f> illumination(const std::vector<Eigen::Vector3f>& light,
                                          const std::vector<Eigen::Vector3f>& reflectance) {
    std::vector<Eigen::Vector3f> result(light.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        float sum = 0.0F;
        float count = 0.0F;
        for (int c = 0; c < 3; ++c) {
            if (reflectance[i][c] < kBlack) continue;
            result[i][c] = light[i][c] / reflectance[i][c];
            sum += result[i][c];
            count += 1.0F;
        }
        for (int c = 0; c < 3; ++c) {
            if (reflectance[i][c] < kBlack) result[i][c] = count > 0.0F ? sum / count : 0.0F;
        }
    }
    return result;
}

PictureLayers averaged(const LayeredImage& image, float scale) {
    PictureLayers layers;
    layers.reflectance = meanOf(image, &LayeredLight::reflectance, 1.0F);
    layers.direct = illumination(meanOf(image, &LayeredLight::direct, scale), layers.reflectance);
    layers.indirect =
        illumination(meanOf(image, &LayeredLight::indirect, scale), layers.reflectance);
    // The residual is all light that is not the product of the other layers.
    layers.residual.assign(layers.size(), Eigen::Vector3f::Zero());
    const float factor = scale / static_cast<float>(std::max(image.samples, 1));
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layers.residual[i] = factor * image.total(i).sum() - layers.light(i);
    }
    return layers;
}

std::vector<std::uint8_t> developed(const PictureLayers& layers) {
    std::vector<std::uint8_t> rgb(3 * layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const Eigen::Vector3f shown = toneCurve(layers.light(i));
        for (int c = 0; c < 3; ++c) rgb[3 * i + c] = encodedByte(shown[c]);
    }
    return rgb;
}

}  // namespace dollytrack::render
