#include "app/statistics/quantity.h"

namespace dollytrack::statistics {
namespace {

constexpr const char* kCoco = "coco in --formats";
constexpr const char* kFrames = "frames in --formats";
constexpr const char* kInstances = "instances in --formats";

constexpr std::array<QuantityInfo, kQuantities> kTable = {{
    {Quantity::BoxShare, "box_share", "Box area", "box area, % of the image", " %", 100.0, "boxes",
     AxisKind::Decades, kCoco, ""},
    {Quantity::MaskShare, "mask_share", "Mask area", "visible pixels of an object, % of the image",
     " %", 100.0, "boxes", AxisKind::Decades, kCoco, ""},
    {Quantity::AspectRatio, "aspect_ratio", "Box aspect ratio", "width / height of the box", "",
     1.0, "boxes", AxisKind::Octaves, kCoco, ""},
    {Quantity::BoxesPerFrame, "boxes_per_frame", "Objects per frame", "boxes in a frame", "", 1.0,
     "frames", AxisKind::Count, kCoco, ""},
    {Quantity::VisibleFraction, "visible_fraction", "Visible fraction",
     "visible part of the silhouette, %", " %", 100.0, "objects in frames", AxisKind::Share,
     kInstances, "The silhouette includes what is occluded or outside the image."},
    {Quantity::BestVisibleFraction, "best_visible_fraction", "Visible fraction in the best frame",
     "visible part of the silhouette, %", " %", 100.0, "objects", AxisKind::Share, "",
     "Each object counts once, in the frame that shows it best."},
    {Quantity::Truncation, "truncation", "Truncation",
     "part of the silhouette outside the image, %", " %", 100.0, "objects in frames",
     AxisKind::Share, kInstances, ""},
    {Quantity::Distance, "distance_m", "Distance to objects", "camera to centre of the object, m",
     " m", 1.0, "boxes", AxisKind::FromZero, kCoco, ""},
    {Quantity::CameraHeight, "camera_height_m", "Camera height", "height above the floor, m", " m",
     1.0, "frames", AxisKind::Linear, "",
     "Above the highest object of class floor below the camera; without one, above z = 0."},
    {Quantity::CameraPitch, "camera_pitch_deg", "Camera pitch", "pitch, degrees (up is positive)",
     "°", 1.0, "frames", AxisKind::Linear, "", ""},
    {Quantity::Speed, "speed_mps", "Camera speed", "speed, m/s", " m/s", 1.0, "frames",
     AxisKind::FromZero, kFrames, ""},
    {Quantity::TurnRate, "turn_dps", "Camera turn rate", "turn rate, degrees per second", "°/s",
     1.0, "frames", AxisKind::FromZero, kFrames, ""},
    {Quantity::Depth, "depth_m", "Depth", "depth of a pixel along the viewing axis, m", " m", 1.0,
     "pixels with a surface", AxisKind::FromZero, "depth in --modalities", ""},
    {Quantity::Luma, "luma", "Brightness", "mean luma of an image, 0 to 255", "", 1.0, "images",
     AxisKind::Byte, "rgb in --modalities", ""},
}};

}  // namespace

std::span<const QuantityInfo, kQuantities> quantities() {
    return kTable;
}

}  // namespace dollytrack::statistics
