#include "app/gather/layouts/ros_messages.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace dollytrack::gather::ros {
namespace {

struct Definition {
    std::string_view type;
    std::string_view fields;
    std::string_view parts;  // types of its fields, separated by blanks
};

// Constants precede the other fields.
constexpr std::array kDefinitions = {
    Definition{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n", ""},
    Definition{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n", ""},
    Definition{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n",
               "builtin_interfaces/Time"},
    Definition{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n", ""},
    Definition{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n", ""},
    Definition{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n", ""},
    Definition{"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n",
               ""},
    Definition{"geometry_msgs/Pose",
               "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n",
               "geometry_msgs/Point geometry_msgs/Quaternion"},
    Definition{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
               "std_msgs/Header geometry_msgs/Pose"},
    Definition{"geometry_msgs/Transform",
               "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n",
               "geometry_msgs/Vector3 geometry_msgs/Quaternion"},
    Definition{"geometry_msgs/TransformStamped",
               "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n",
               "std_msgs/Header geometry_msgs/Transform"},
    Definition{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n",
               "geometry_msgs/TransformStamped"},
    Definition{"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n",
               "std_msgs/Header geometry_msgs/PoseStamped"},
    Definition{"sensor_msgs/CompressedImage",
               "std_msgs/Header header\nstring format\nuint8[] data\n", "std_msgs/Header"},
    Definition{"sensor_msgs/RegionOfInterest",
               "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n",
               ""},
    Definition{"sensor_msgs/CameraInfo",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
               "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\n"
               "uint32 binning_y\nsensor_msgs/RegionOfInterest roi\n",
               "std_msgs/Header sensor_msgs/RegionOfInterest"},
    Definition{"sensor_msgs/Imu",
               "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
               "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
               "float64[9] angular_velocity_covariance\n"
               "geometry_msgs/Vector3 linear_acceleration\n"
               "float64[9] linear_acceleration_covariance\n",
               "std_msgs/Header geometry_msgs/Quaternion geometry_msgs/Vector3"},
    Definition{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n", ""},
    Definition{"visualization_msgs/MeshFile", "string filename\nuint8[] data\n", ""},
    Definition{"visualization_msgs/Marker",
               "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\n"
               "int32 LINE_STRIP=4\nint32 LINE_LIST=5\nint32 CUBE_LIST=6\nint32 SPHERE_LIST=7\n"
               "int32 POINTS=8\nint32 TEXT_VIEW_FACING=9\nint32 MESH_RESOURCE=10\n"
               "int32 TRIANGLE_LIST=11\nint32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\n"
               "int32 DELETEALL=3\nstd_msgs/Header header\nstring ns\nint32 id\nint32 type\n"
               "int32 action\ngeometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\n"
               "std_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\n"
               "bool frame_locked\ngeometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\n"
               "string texture_resource\nsensor_msgs/CompressedImage texture\n"
               "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
               "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\n"
               "bool mesh_use_embedded_materials\n",
               "std_msgs/Header geometry_msgs/Pose geometry_msgs/Vector3 std_msgs/ColorRGBA "
               "builtin_interfaces/Duration geometry_msgs/Point sensor_msgs/CompressedImage "
               "visualization_msgs/UVCoordinate visualization_msgs/MeshFile"},
    Definition{"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n",
               "visualization_msgs/Marker"},
};

/// Types that differ in ROS 1 or that only ROS 1 needs.
constexpr std::array kRos1Definitions = {
    Definition{"std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n", ""},
    Definition{"std_msgs/String", "string data\n", ""},
    Definition{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", ""},
    Definition{"sensor_msgs/CameraInfo",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
               "float64[] D\nfloat64[9] K\nfloat64[9] R\nfloat64[12] P\nuint32 binning_x\n"
               "uint32 binning_y\nsensor_msgs/RegionOfInterest roi\n",
               "std_msgs/Header sensor_msgs/RegionOfInterest"},
    Definition{"visualization_msgs/Marker",
               "uint8 ARROW=0\nuint8 CUBE=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\n"
               "uint8 LINE_STRIP=4\nuint8 LINE_LIST=5\nuint8 CUBE_LIST=6\nuint8 SPHERE_LIST=7\n"
               "uint8 POINTS=8\nuint8 TEXT_VIEW_FACING=9\nuint8 MESH_RESOURCE=10\n"
               "uint8 TRIANGLE_LIST=11\nuint8 ADD=0\nuint8 MODIFY=0\nuint8 DELETE=2\n"
               "uint8 DELETEALL=3\nstd_msgs/Header header\nstring ns\nint32 id\nint32 type\n"
               "int32 action\ngeometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\n"
               "std_msgs/ColorRGBA color\nduration lifetime\nbool frame_locked\n"
               "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring text\n"
               "string mesh_resource\nbool mesh_use_embedded_materials\n",
               "std_msgs/Header geometry_msgs/Pose geometry_msgs/Vector3 std_msgs/ColorRGBA "
               "geometry_msgs/Point"},
};

struct Md5Sum {
    std::string_view type;
    std::string_view sum;
};

/// MD5 sums of the recorded types, as `rosmsg md5 TYPE` prints them.
constexpr std::array kMd5Sums = {
    Md5Sum{"nav_msgs/Path", "6227e2b7e9cce15051f669a5e197bbf7"},
    Md5Sum{"sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214"},
    Md5Sum{"sensor_msgs/CompressedImage", "8f7a12909da2c9d3332d540a0977563f"},
    Md5Sum{"sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2"},
    Md5Sum{"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1"},
    Md5Sum{"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"},
    Md5Sum{"visualization_msgs/MarkerArray", "d155b9ce5188fbaf89745847fd5882d7"},
};

const Definition& find(Version version, std::string_view type) {
    const auto ros1 = std::ranges::find(kRos1Definitions, type, &Definition::type);
    if (version == Version::Ros1 && ros1 != kRos1Definitions.end()) return *ros1;
    const auto found = std::ranges::find(kDefinitions, type, &Definition::type);
    if (found != kDefinitions.end()) return *found;
    throw std::logic_error("no definition of the message type " + std::string(type));
}

/// Adds the parts of a type that the list lacks, then their parts.
void listParts(Version version, std::string_view type, std::vector<std::string_view>& types) {
    for (std::string_view left = find(version, type).parts; !left.empty();) {
        const std::string_view part = left.substr(0, left.find(' '));
        left.remove_prefix(std::min(part.size() + 1, left.size()));
        if (std::ranges::find(types, part) != types.end()) continue;
        types.push_back(part);
        listParts(version, part, types);
    }
}

}  // namespace

std::string definitionOf(Version version, std::string_view type) {
    std::vector<std::string_view> types;
    listParts(version, type, types);
    std::string text(find(version, type).fields);
    for (const std::string_view one : types) {
        text += std::string(80, '=') + "\nMSG: ";
        text += one;
        text += '\n';
        text += find(version, one).fields;
    }
    return text;
}

std::string_view md5Of(std::string_view type) {
    const auto found = std::ranges::find(kMd5Sums, type, &Md5Sum::type);
    if (found != kMd5Sums.end()) return found->sum;
    throw std::logic_error("no MD5 sum of the message type " + std::string(type));
}

}  // namespace dollytrack::gather::ros
