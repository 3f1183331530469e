#include "render/verify/check/check_cameras.h"
#include "render/verify/check/check_euroc.h"
#include "render/verify/check_list.h"

#include <array>

namespace dollytrack::verify {
namespace {

using Names = std::span<const char* const>;

constexpr std::array kInstance = {"instance"};
constexpr std::array kPictures = {"rgb", "instance"};
constexpr std::array kRgb = {"rgb"};
constexpr std::array kAnyDepth = {"depth", "depth_exr"};
constexpr std::array kCoco = {"coco", "instance"};
constexpr std::array kFrames = {"frames", "instance"};
constexpr std::array kImu = {"imu"};
constexpr std::array kExactDepth = {"depth_exr", "depth"};
constexpr std::array kNormals = {"normal_camera", "normal_world"};
constexpr std::array kCoordinates = {"object_coordinates", "instance"};
constexpr std::array kFlow = {"flow_forward", "flow_backward"};
constexpr std::array kStereo = {"disparity", "rgb_right", "depth_right"};
constexpr std::array kAmodal = {"amodal"};
constexpr std::array kInstances = {"instances", "instance"};
constexpr std::array kYolo = {"yolo", "instance"};
constexpr std::array kBop = {"bop", "instance"};
constexpr std::array kGltf = {"gltf"};
constexpr std::array kCameraJson = {"camera_json"};
constexpr std::array kTransforms = {"nerfstudio", "instant_ngp"};
constexpr std::array kColmap = {"colmap"};
constexpr std::array kTum = {"tum"};
constexpr std::array kEuroc = {"euroc"};
constexpr std::array kKitti = {"kitti"};
constexpr std::array kTartanAir = {"tartanair"};
constexpr std::array kKittiObjects = {"kitti_objects", "instance"};
constexpr std::array kHdf5 = {"hdf5"};
constexpr std::array kPolygons = {"coco_polygons", "instance"};
constexpr std::array kFolds = {"folds"};
constexpr std::array kVideo = {"video", "rgb"};
constexpr std::array kRgbSensor = {"rgb_sensor"};
constexpr std::array kDepthSensor = {"depth_sensor"};
constexpr std::array kCameras = {"cameras"};
constexpr std::array kAlbedo = {"albedo", "instance"};

constexpr std::array kChecks = {
    Check{"files", "every file is there with its hash, and no other", Names{}, Names{}, false,
          beginFiles},
    Check{"card", "dataset.json agrees with itself and with the program's conventions", Names{},
          Names{}, false, beginCard},
    Check{"images", "images can be read and have the size and type said", Names{}, Names{}, false,
          beginImages},
    Check{"motion", "timestamps rise, quaternions have unit length", Names{}, Names{}, false,
          beginMotion},
    Check{"classes", "ids are those of objects, classes those of the ids", kInstance, Names{},
          false, beginClasses},
    Check{"holes", "depth is missing exactly where no object is", kInstance, kAnyDepth, false,
          beginHoles},
    Check{"pictures", "edges in the pictures are where the objects in sight meet", kPictures,
          Names{}, false, beginPictures},
    Check{"usable", "dark, white and flat pictures are those that dataset.json lists", kRgb,
          Names{}, false, beginUsable},
    Check{"object_boxes", "depth unprojected lies in the box of the object seen", kInstance,
          kAnyDepth, false, beginObjectBoxes},
    Check{"captures", "the captures counted are those in the images", kInstance, Names{}, false,
          beginCaptures},
    Check{"scene", "the scene has the objects that dataset.json lists", Names{}, Names{}, true,
          beginScene},
    Check{"surface", "each pixel shows what a ray through its centre meets in the scene", kInstance,
          kAnyDepth, true, beginSurface},
    Check{"coco", "masks, boxes, areas and categories are those of the instance images", kCoco,
          Names{}, false, beginCoco},
    Check{"poses", "each pose file, read again, gives the same poses to 1e-6", Names{}, Names{},
          false, beginPoses},
    Check{"frames", "the numbers of frames.csv, computed again", kFrames, Names{}, false,
          beginFrames},
    Check{"imu", "inertial measurements, integrated, lead from pose to pose", kImu, Names{}, false,
          beginImu},
    Check{"depth_exr", "depth in floats is depth in millimetres", kExactDepth, Names{}, false,
          beginExactDepth},
    Check{"normals", "normals have unit length and are those of the surfaces seen", Names{},
          kNormals, false, beginNormals},
    Check{"object_coordinates", "coordinates are the depth, unprojected into the object's box",
          kCoordinates, kAnyDepth, false, beginObjectCoordinates},
    Check{"flow", "flow is what depth and poses say, to 0.01 px, and its masks what is seen",
          Names{}, kFlow, false, beginFlow},
    Check{"stereo", "disparity is what depth says, and the right pictures show the same", Names{},
          kStereo, false, beginStereo},
    Check{"amodal", "whole masks hold the visible ones", kAmodal, Names{}, false, beginAmodal},
    Check{"instances", "the numbers of instances.csv, counted again", kInstances, Names{}, false,
          beginInstances},
    Check{"yolo", "boxes, outlines and classes of the labels are those of the instance images",
          kYolo, Names{}, false, beginYolo},
    Check{"bop", "BOP's poses, masks and counts are dataset.json's and the instance images'", kBop,
          Names{}, false, beginBop},
    Check{"gltf", "the animated camera and things are where dataset.json has them", kGltf, Names{},
          false, beginGltf},
    Check{"camera_json", "lens, planes and targets of camera.json are the frames'", kCameraJson,
          Names{}, false, beginCameraJson},
    Check{"transforms", "lens and names are the frames', and the room is in the unit cube", Names{},
          kTransforms, false, beginTransforms},
    Check{"colmap", "lens and names are the frames', and the points lie on what these show",
          kColmap, Names{}, false, beginColmap},
    Check{"tum", "TUM's depth is the depth, and its lists name each frame's pictures", kTum,
          Names{}, false, beginTum},
    Check{"euroc", "EuRoC's times, poses, lenses and pictures are the frames'", kEuroc, Names{},
          false, beginEuroc},
    Check{"kitti", "KITTI's projections are the lens's, its motions what depth and poses say",
          kKitti, Names{}, false, beginKitti},
    Check{"tartanair", "TartanAir's pictures, depth, classes and motions are the frames'",
          kTartanAir, Names{}, false, beginTartanAir},
    Check{"kitti_objects", "KITTI's labels are what the instance images and the boxes say",
          kKittiObjects, Names{}, false, beginKittiObjects},
    Check{"hdf5", "HDF5's images and poses are the frames'", kHdf5, Names{}, false, beginHdf5},
    Check{"coco_polygons", "outlines hold the instance images' pixels, and what these enclose",
          kPolygons, Names{}, false, beginCocoPolygons},
    Check{"folds",
          "every frame is held back once, and none is trained on that is nearer to those than "
          "dataset.json allows",
          kFolds, Names{}, false, beginFolds},
    Check{"video", "the preview shows every picture, in order", kVideo, Names{}, false, beginVideo},
    Check{"albedo", "base colours are those of the materials seen", kAlbedo, Names{}, true,
          beginAlbedo},
    Check{"rgb_sensor", "the sensor's pictures show their frames, by the lens and times said",
          kRgbSensor, Names{}, false, beginRgbSensor},
    Check{"depth_sensor", "the depth camera's depth is the depth within its noise, and its holes",
          kDepthSensor, kAnyDepth, false, beginDepthSensor},
    Check{"cameras",
          "the rig's cameras show what the rays of their lenses meet, from where they ride",
          kCameras, Names{}, false, beginCameras},
};

}  // namespace

std::span<const Check> checks() {
    return kChecks;
}

}  // namespace dollytrack::verify
