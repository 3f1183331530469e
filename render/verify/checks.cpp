#include "render/verify/checks.h"

#include "engine/io/hdf5/hdf5_reader.h"
#include "render/formats/media/video_encoder.h"
#include "render/verify/check/check_list.h"

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
constexpr std::array kSceneFlow = {"scene_flow"};
constexpr std::array kTracks = {"tracks"};
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
constexpr std::array kMaterials = {"roughness", "metallic"};
constexpr std::array kLight = {"hdr", "direct_illumination"};

constexpr std::array kChecks = {
    Check{"files", "all listed files exist with their hashes, and no others", Names{}, Names{},
          false, beginFiles},
    Check{"card", "dataset.json is consistent and follows the program's conventions", Names{},
          Names{}, false, beginCard},
    Check{"images", "images can be read and have the stated size and type", Names{}, Names{}, false,
          beginImages},
    Check{"motion", "timestamps rise, quaternions have unit length", Names{}, Names{}, false,
          beginMotion},
    Check{"classes", "ids belong to objects, and classes match the ids", kInstance, Names{}, false,
          beginClasses},
    Check{"holes", "depth is missing exactly where no object is", kInstance, kAnyDepth, false,
          beginHoles},
    Check{"pictures", "edges in the images coincide with object borders", kPictures, Names{}, false,
          beginPictures},
    Check{"usable", "dark, white and flat images are those that dataset.json lists", kRgb, Names{},
          false, beginUsable},
    Check{"object_boxes", "unprojected depth lies in the box of the visible object", kInstance,
          kAnyDepth, false, beginObjectBoxes},
    Check{"captures", "the counted captures agree with the images", kInstance, Names{}, false,
          beginCaptures},
    Check{"scene", "the scene has the objects that dataset.json lists", Names{}, Names{}, true,
          beginScene},
    Check{"surface", "each pixel agrees with the ray through its centre", kInstance, kAnyDepth,
          true, beginSurface},
    Check{"coco", "masks, boxes, areas and categories agree with the instance images", kCoco,
          Names{}, false, beginCoco},
    Check{"poses", "each pose file contains the same poses to 1e-6", Names{}, Names{}, false,
          beginPoses},
    Check{"frames", "the numbers of frames.csv agree with recomputed ones", kFrames, Names{}, false,
          beginFrames},
    Check{"imu", "integrated inertial measurements agree with the poses", kImu, Names{}, false,
          beginImu},
    Check{"depth_exr", "float depth agrees with millimetre depth", kExactDepth, Names{}, false,
          beginExactDepth},
    Check{"normals", "normals have unit length and agree with the surfaces", Names{}, kNormals,
          false, beginNormals},
    Check{"object_coordinates",
          "object coordinates agree with the depth unprojected into the object's box", kCoordinates,
          kAnyDepth, false, beginObjectCoordinates},
    Check{"flow", "flow and its masks agree with depth and poses to 0.01 px", Names{}, kFlow, false,
          beginFlow},
    Check{"scene_flow", "scene flow agrees with depth and poses", kSceneFlow, kAnyDepth, false,
          beginSceneFlow},
    Check{"tracks", "tracked points agree with poses, depth, ids and the motion of their objects",
          kTracks, Names{}, false, beginTracks},
    Check{"stereo", "disparity and the right images agree with the depth", Names{}, kStereo, false,
          beginStereo},
    Check{"amodal", "amodal masks contain the visible masks", kAmodal, Names{}, false, beginAmodal},
    Check{"instances", "the numbers of instances.csv agree with recounted ones", kInstances,
          Names{}, false, beginInstances},
    Check{"yolo", "boxes, outlines and classes of the labels agree with the instance images", kYolo,
          Names{}, false, beginYolo},
    Check{"bop", "BOP's poses, masks and counts agree with dataset.json and the instance images",
          kBop, Names{}, false, beginBop},
    Check{"gltf", "the animated camera and objects agree with dataset.json", kGltf, Names{}, false,
          beginGltf},
    Check{"camera_json", "lens, planes and targets of camera.json agree with the frames",
          kCameraJson, Names{}, false, beginCameraJson},
    Check{"transforms", "lens and names agree with the frames, and the room fits the unit cube",
          Names{}, kTransforms, false, beginTransforms},
    Check{"colmap", "lens and names agree with the frames, and the points lie on visible surfaces",
          kColmap, Names{}, false, beginColmap},
    Check{"tum", "TUM's depth agrees with the depth, and its lists name each frame's images", kTum,
          Names{}, false, beginTum},
    Check{"euroc", "EuRoC's times, poses, lenses and images agree with the frames", kEuroc, Names{},
          false, beginEuroc},
    Check{"kitti", "KITTI's projections agree with the lens, its motions with depth and poses",
          kKitti, Names{}, false, beginKitti},
    Check{"tartanair", "TartanAir's images, depth, classes and motions agree with the frames",
          kTartanAir, Names{}, false, beginTartanAir},
    Check{"kitti_objects", "KITTI's labels agree with the instance images and the boxes",
          kKittiObjects, Names{}, false, beginKittiObjects},
    Check{"hdf5", "HDF5's images and poses agree with the frames", kHdf5, Names{}, false, beginHdf5,
          missingHdf5},
    Check{"coco_polygons", "outlines contain the instance images' pixels and the holes in them",
          kPolygons, Names{}, false, beginCocoPolygons},
    Check{"folds",
          "each frame is validated once, and no training frame is closer to these than "
          "dataset.json allows",
          kFolds, Names{}, false, beginFolds},
    Check{"video", "the preview shows every image, in order", kVideo, Names{}, false, beginVideo,
          render::missingVideoLibrary},
    Check{"albedo", "base colours agree with the visible materials", kAlbedo, Names{}, true,
          beginAlbedo},
    Check{"materials", "roughness and metalness are those of the visible materials", kInstance,
          kMaterials, true, beginMaterials},
    Check{"light", "the layers of path-traced light add up, and give the image by the tone curve",
          Names{}, kLight, false, beginLight},
    Check{"rgb_sensor", "sensor images agree with their frames, by the stated lens and times",
          kRgbSensor, Names{}, false, beginRgbSensor},
    Check{"depth_sensor", "sensor depth and its holes agree with the depth, within the noise model",
          kDepthSensor, kAnyDepth, false, beginDepthSensor},
    Check{"cameras", "the rig's images agree with the rays of their lenses, at their mounted poses",
          kCameras, Names{}, false, beginCameras},
};

}  // namespace

std::span<const Check> checks() {
    return kChecks;
}

}  // namespace dollytrack::verify
