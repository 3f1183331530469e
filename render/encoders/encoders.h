#pragma once

#include "engine/core/result.h"
#include "render/dataset/contents/frame_context.h"
#include "render/frames/frame_file.h"
#include "render/frames/frame_record.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

// Encoder and dataset.json description of each modality, for the table in modalities.cpp.
namespace dollytrack::render {

using FrameFiles = Result<std::vector<FrameFile>>;

FrameFiles encodeRgb(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDepth(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDepthExr(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeInstance(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeSemantic(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json rgbConvention(const DatasetContents& contents);
nlohmann::ordered_json depthConvention(const DatasetContents& contents);
nlohmann::ordered_json depthExrConvention(const DatasetContents& contents);
nlohmann::ordered_json instanceConvention(const DatasetContents& contents);
nlohmann::ordered_json semanticConvention(const DatasetContents& contents);

FrameFiles encodeNormalCamera(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeNormalWorld(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeAlbedo(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeObjectCoordinates(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json normalCameraConvention(const DatasetContents& contents);
nlohmann::ordered_json normalWorldConvention(const DatasetContents& contents);
nlohmann::ordered_json albedoConvention(const DatasetContents& contents);
nlohmann::ordered_json objectCoordinatesConvention(const DatasetContents& contents);

FrameFiles encodeRoughness(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeMetallic(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json roughnessConvention(const DatasetContents& contents);
nlohmann::ordered_json metallicConvention(const DatasetContents& contents);

FrameFiles encodeHdr(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDiffuseReflectance(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDiffuseIllumination(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDirectIllumination(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeIndirectIllumination(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeResidual(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json hdrConvention(const DatasetContents& contents);
nlohmann::ordered_json diffuseReflectanceConvention(const DatasetContents& contents);
nlohmann::ordered_json diffuseIlluminationConvention(const DatasetContents& contents);
nlohmann::ordered_json directIlluminationConvention(const DatasetContents& contents);
nlohmann::ordered_json indirectIlluminationConvention(const DatasetContents& contents);
nlohmann::ordered_json residualConvention(const DatasetContents& contents);

FrameFiles encodeFlowForward(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeFlowBackward(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeSceneFlow(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeTracks(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json flowForwardConvention(const DatasetContents& contents);
nlohmann::ordered_json flowBackwardConvention(const DatasetContents& contents);
nlohmann::ordered_json sceneFlowConvention(const DatasetContents& contents);
nlohmann::ordered_json tracksConvention(const DatasetContents& contents);

FrameFiles encodeRgbRight(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDepthRight(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDisparity(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json rgbRightConvention(const DatasetContents& contents);
nlohmann::ordered_json depthRightConvention(const DatasetContents& contents);
nlohmann::ordered_json disparityConvention(const DatasetContents& contents);

FrameFiles encodeAmodal(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json amodalConvention(const DatasetContents& contents);

FrameFiles encodeRgbSensor(const FrameContext& context, const FrameRecord& frame);
FrameFiles encodeDepthSensor(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json rgbSensorConvention(const DatasetContents& contents);
nlohmann::ordered_json depthSensorConvention(const DatasetContents& contents);
FrameFiles encodeCameras(const FrameContext& context, const FrameRecord& frame);
nlohmann::ordered_json camerasConvention(const DatasetContents& contents);

}  // namespace dollytrack::render
