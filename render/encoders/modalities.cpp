#include "render/encoders/modalities.h"

#include "render/dataset/contents/name_selection.h"
#include "render/encoders/encoders.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace dollytrack::render {
namespace {

using enum ContentGroup;

// Bytes per pixel were measured in real rooms at 640 x 480.
constexpr std::array<Modality, 28> kModalities = {{
    {"rgb", "8-bit colour images", Colour, 1.2, true, kNeedsRgb, encodeRgb, rgbConvention},
    {"depth", "16-bit depth along the viewing axis, in millimetres", Geometry, 0.3, true,
     kNeedsDepth, encodeDepth, depthConvention},
    {"instance", "16-bit object ids, walls and floors included", Labels, 0.06, true, 0,
     encodeInstance, instanceConvention},
    {"semantic", "8-bit classes, NYU40 or those of --labels (16-bit beyond 255)", Labels, 0.04,
     true, 0, encodeSemantic, semanticConvention},
    {"depth_exr", "32-bit float depth along the viewing axis, in metres (OpenEXR)", Geometry, 2.5,
     false, kNeedsDepth, encodeDepthExr, depthExrConvention, false},
    {"normal_camera", "16-bit surface normals in the camera's axes", Geometry, 2.0, false,
     kNeedsSurfaces, encodeNormalCamera, normalCameraConvention},
    {"normal_world", "16-bit surface normals in the world's axes", Geometry, 1.0, false,
     kNeedsSurfaces, encodeNormalWorld, normalWorldConvention},
    {"albedo", "8-bit base colour, without light", Colour, 0.5, false, kNeedsSurfaces, encodeAlbedo,
     albedoConvention},
    {"roughness", "8-bit roughness of the surface's material", Colour, 0.3, false, 0,
     encodeRoughness, roughnessConvention},
    {"metallic", "8-bit metallic share of the surface's material", Colour, 0.1, false, 0,
     encodeMetallic, metallicConvention},
    {"object_coordinates", "16-bit coordinates in the object's own box", Geometry, 4.0, false,
     kNeedsDepth, encodeObjectCoordinates, objectCoordinatesConvention},
    {"flow_forward", "optical flow to later frames, with occlusion (Middlebury .flo)", Motion, 8.1,
     false, kNeedsDepth, encodeFlowForward, flowForwardConvention, false, true},
    {"flow_backward", "optical flow to earlier frames, with occlusion (Middlebury .flo)", Motion,
     8.1, false, kNeedsDepth, encodeFlowBackward, flowBackwardConvention, false, true},
    {"scene_flow", "3D motion to later frames, in metres, 32-bit float (OpenEXR)", Motion, 9.0,
     false, kNeedsDepth, encodeSceneFlow, sceneFlowConvention, false, true},
    {"tracks", "points followed through 300 frames, with occlusion (NumPy arrays as in TAP-Vid)",
     Motion, 0.8, false, 0, encodeTracks, tracksConvention, false, false, 220e3},
    {"rgb_right", "8-bit colour images of the stereo pair's right camera", Sensors, 1.2, false,
     kNeedsRight, encodeRgbRight, rgbRightConvention},
    {"depth_right", "16-bit depth of the right camera, in millimetres", Sensors, 0.3, false,
     kNeedsRight, encodeDepthRight, depthRightConvention},
    {"disparity", "16-bit stereo disparity, with occlusion (KITTI's PNG)", Sensors, 0.6, false,
     kNeedsDepth, encodeDisparity, disparityConvention},
    {"amodal", "masks of whole objects, hidden parts included (JSON of run lengths)", Labels, 0.1,
     false, kNeedsWhole, encodeAmodal, amodalConvention, false},
    {"rgb_sensor",
     "8-bit colour images of a simulated camera sensor: blur, lens, noise, see sensor_preset",
     Sensors, 2.6, false, kNeedsSensorLight, encodeRgbSensor, rgbSensorConvention},
    {"depth_sensor", "16-bit depth of a simulated depth camera, in millimetres, see depth_noise",
     Sensors, 1.6, false, kNeedsDepth | kNeedsSurfaces, encodeDepthSensor, depthSensorConvention},
    {"hdr", "light before the tone curve, 16-bit float (OpenEXR); path-traced images only", Light,
     3.5, false, kNeedsLayers, encodeHdr, hdrConvention, false},
    {"diffuse_reflectance", "diffuse reflectance, 16-bit float (OpenEXR); path-traced images only",
     Light, 2.0, false, kNeedsLayers, encodeDiffuseReflectance, diffuseReflectanceConvention,
     false},
    {"diffuse_illumination",
     "light on diffuse surfaces, 16-bit float (OpenEXR); path-traced images only", Light, 3.5,
     false, kNeedsLayers, encodeDiffuseIllumination, diffuseIlluminationConvention, false},
    {"direct_illumination",
     "diffuse illumination directly from light sources, 16-bit float (OpenEXR); path-traced images "
     "only",
     Light, 3.5, false, kNeedsLayers, encodeDirectIllumination, directIlluminationConvention,
     false},
    {"indirect_illumination",
     "diffuse illumination from other surfaces, 16-bit float (OpenEXR); path-traced images only",
     Light, 3.5, false, kNeedsLayers, encodeIndirectIllumination, indirectIlluminationConvention,
     false},
    {"residual",
     "reflections and visible emission, 16-bit float (OpenEXR); path-traced images only", Light,
     3.5, false, kNeedsLayers, encodeResidual, residualConvention, false},
    {kRigModality, "colour, depth, ids, classes and normals of every camera of --rig", Sensors, 2.6,
     false, kNeedsRig, encodeCameras, camerasConvention, false},
}};

}  // namespace

std::span<const Modality> modalities() {
    return kModalities;
}

Result<ModalitySet> chooseModalities(const std::vector<std::string>& names) {
    return chooseRows(modalities(), names, "modality", "--modalities");
}

Result<ModalitySet> chooseModalities(const std::vector<std::string>& names, Available available) {
    Result<ModalitySet> chosen = chooseModalities(names);
    if (!chosen) return chosen;
    const auto named = [&](std::string_view name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Modality* one : available.layers ? ModalitySet() : *chosen) {
        if ((one->needs & kNeedsLayers) == 0 || !named(one->name)) continue;
        return fail(ErrorCode::Usage,
                    fmt::format("The modality '{}' needs path-traced images: add --set "
                                "render_mode=traced, or render_mode=reference.",
                                one->name),
                    "--modalities");
    }
    std::erase_if(*chosen, [&](const Modality* one) {
        return !available.layers && (one->needs & kNeedsLayers) != 0;
    });
    const auto of_rig = std::find_if(modalities().begin(), modalities().end(), [](const auto& row) {
        return std::string_view(row.name) == kRigModality;
    });
    std::erase(*chosen, &*of_rig);
    if (available.rig) {
        const auto later = std::find_if(chosen->begin(), chosen->end(),
                                        [&](const Modality* one) { return one > &*of_rig; });
        chosen->insert(later, &*of_rig);
    } else if (named(kRigModality)) {
        return fail(ErrorCode::Usage,
                    "The modality 'cameras' needs a rig: pass a rig file with --rig, or describe "
                    "each camera, as in --camera left:yaw_deg=-90.",
                    "--modalities");
    }
    return chosen;
}

}  // namespace dollytrack::render
