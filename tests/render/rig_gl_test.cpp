#include "render/frames/frame_file.h"
#include "render/light/light_rig.h"
#include "render/light/light_volume.h"
#include "render/rig/rig_clearance.h"
#include "render/rig/rig_files.h"
#include "render/rig/rig_pictures.h"
#include "tests/render/dataset/dataset_fixture.h"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <numbers>

namespace dollytrack::render::rig_gl_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using fixture::smallCamera;

constexpr double kPi = std::numbers::pi;
const Vector3d kLow(0.0, 0.0, 0.0);
const Vector3d kHigh(4.0, 5.0, 3.0);

RigCamera cameraOf(const std::string& name, Lens lens) {
    RigCamera camera = standardCamera(lens);
    camera.name = name;
    camera.width_px = lens == Lens::Equirectangular ? 256 : 160;
    camera.height_px = lens == Lens::Fisheye ? 160 : lens == Lens::Equirectangular ? 128 : 120;
    return camera;
}

/// Distance to the walls of the empty room, in multiples of the direction's length.
double toWalls(const Vector3d& from, const Vector3d& direction) {
    double nearest = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) continue;
        const double wall = direction[axis] > 0.0 ? kHigh[axis] : kLow[axis];
        nearest = std::min(nearest, (wall - from[axis]) / direction[axis]);
    }
    return nearest;
}

class RigGl : public fixture::DatasetGlTest {
  protected:
    void emptyRoom() {
        scene_ = dollytrack::test::SceneBuilder().room(kLow, kHigh).build();
        rays_ = RayCaster(scene_);
    }

    void exportRig(const Rig& rig, const Trajectory& trajectory,
                   std::vector<std::string> modalities = {}) {
        DatasetSettings settings;
        settings.folder = folder_ / "out";
        settings.rig = rig;
        settings.modalities = std::move(modalities);
        const auto summary = exportWith(settings, trajectory);
        ASSERT_TRUE(summary) << describe(summary.error());
    }

    cv::Mat image(const std::string& folder, int frame = 0) const {
        const fs::path path = folder_ / "out" / frameFile(folder, frame);
        cv::Mat found = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
        EXPECT_FALSE(found.empty()) << path;
        return found;
    }
    cv::Mat rigImage(const std::string& camera, const std::string& image_of, int frame = 0) const {
        return image(rigFolder(camera, image_of), frame);
    }
    nlohmann::json card() const {
        return nlohmann::json::parse(read(folder_ / "out" / "dataset.json"));
    }
};

Trajectory one(const Vector3d& from, const Vector3d& to) {
    Trajectory trajectory;
    TrajectoryFrame frame;
    frame.pose = lookAt(from, to);
    frame.target_in_world = to;
    trajectory.frames.push_back(frame);
    return trajectory;
}

// Expected values for each pixel: the direction by longitude and latitude, and the distance to the
// walls.
TEST_F(RigGl, APanoramasDepthIsTheExactDistanceAlongEachRay) {
    emptyRoom();
    RigCamera all = cameraOf("all", Lens::Equirectangular);
    all.level = true;
    const Vector3d eye(1.3, 2.1, 1.2);
    exportRig({all}, one(eye, {4.0, 2.1, 0.7}));  // tilted down, along +x
    const cv::Mat depth = rigImage("all", "depth"), normal = rigImage("all", "normal_world");
    ASSERT_EQ(depth.type(), CV_16UC1);
    ASSERT_EQ(depth.size(), cv::Size(256, 128));
    for (int y = 0; y < depth.rows; ++y) {
        for (int x = 0; x < depth.cols; ++x) {
            const double lon = 2.0 * kPi * ((x + 0.5) / 256.0 - 0.5);
            const double lat = kPi * (0.5 - (y + 0.5) / 128.0);
            // Ahead is +x, right is -y, up is +z.
            const Vector3d direction(std::cos(lat) * std::cos(lon), -std::cos(lat) * std::sin(lon),
                                     std::sin(lat));
            const double expected = toWalls(eye, direction);
            ASSERT_NEAR(0.001 * depth.at<std::uint16_t>(y, x), expected, 0.00051) << x << " " << y;
            // The normal points against the axis along which the ray leaves the room.
            const Vector3d place = eye + expected * direction;
            const cv::Vec3w bgr = normal.at<cv::Vec3w>(y, x);
            const Vector3d n =
                Vector3d(bgr[2], bgr[1], bgr[0]) * (2.0 / 65535.0) - Vector3d::Ones();
            int axis = 0;
            n.cwiseAbs().maxCoeff(&axis);
            ASSERT_NEAR(n.cwiseAbs()[axis], 1.0, 1e-4);
            ASSERT_NEAR(place[axis], n[axis] < 0.0 ? kHigh[axis] : kLow[axis], 1e-6);
        }
    }
}

TEST_F(RigGl, AFisheyeSeesItsCircleAndNothingAround) {
    emptyRoom();
    RigCamera wide = cameraOf("wide", Lens::Fisheye);
    wide.fov_deg = 200.0;
    const Vector3d eye(1.3, 2.1, 1.2);
    exportRig({wide}, one(eye, {4.0, 2.1, 1.2}));
    const cv::Mat depth = rigImage("wide", "depth"), ids = rigImage("wide", "instance");
    const cv::Mat rgb = rigImage("wide", "rgb");
    const double focal = 80.0 / (100.0 * kPi / 180.0);
    int inside = 0;
    for (int y = 0; y < 160; ++y) {
        for (int x = 0; x < 160; ++x) {
            const double across = x + 0.5 - 80.0, below = y + 0.5 - 80.0;
            const double r = std::hypot(across, below);
            const auto colour = rgb.at<cv::Vec3b>(y, x);
            if (r > 80.0) {
                ASSERT_EQ(depth.at<std::uint16_t>(y, x), 0);
                ASSERT_EQ(ids.at<std::uint16_t>(y, x), 0);
                ASSERT_EQ(colour, cv::Vec3b(0, 0, 0)) << x << " " << y;
                continue;
            }
            ++inside;
            const double angle = r / focal;
            const Vector3d direction(std::cos(angle), -std::sin(angle) * across / r,
                                     -std::sin(angle) * below / r);
            ASSERT_NEAR(0.001 * depth.at<std::uint16_t>(y, x), toWalls(eye, direction), 0.00051);
            ASSERT_NE(ids.at<std::uint16_t>(y, x), 0);
            ASSERT_GT(colour[0] + colour[1] + colour[2], 0) << x << " " << y;
        }
    }
    EXPECT_NEAR(inside, kPi * 80 * 80, 100);
}

// A box 0.8 m wide and 0.3 m high has the same size at any distance: 80 px per metre.
TEST_F(RigGl, ParallelRaysShowThingsToScale) {
    dollytrack::test::SceneBuilder builder;
    builder.room(kLow, kHigh);
    builder.object("crate").box({2.5, 2.0, 1.0}, {0.5, 0.8, 0.3});
    scene_ = builder.build();
    rays_ = RayCaster(scene_);
    RigCamera plan = cameraOf("plan", Lens::Orthographic);
    plan.px_per_m = 80.0;
    exportRig({plan}, one({0.5, 2.0, 1.0}, {3.0, 2.0, 1.0}));
    const cv::Mat ids = rigImage("plan", "instance"), depth = rigImage("plan", "depth");
    const cv::Mat rgb = rigImage("plan", "rgb");
    int crate = 0;
    for (const Object& object : scene_.objects) {
        if (object.name == "crate") crate = object.id;
    }
    const cv::Mat is_crate = ids == crate;
    EXPECT_EQ(cv::countNonZero(is_crate.row(60)), 64);
    EXPECT_EQ(cv::countNonZero(is_crate.col(80)), 24);
    EXPECT_EQ(cv::countNonZero(is_crate), 64 * 24);
    EXPECT_EQ(depth.at<std::uint16_t>(60, 80), 1750);
    EXPECT_EQ(depth.at<std::uint16_t>(60, 50), 1750);
    EXPECT_EQ(depth.at<std::uint16_t>(60, 20), 3500);
    // The image agrees with the labels: it changes at the crate's borders and not inside.
    const auto at = [&](int x) { return cv::norm(rgb.at<cv::Vec3b>(60, x)); };
    EXPECT_GT(std::abs(at(46) - at(49)), 4.0);
    EXPECT_LT(std::abs(at(52) - at(55)), 4.0);
}

/// Pixels of two images that differ by more than `most` in any channel.
int differing(const cv::Mat& a, const cv::Mat& b, double most) {
    cv::Mat difference;
    cv::absdiff(a, b, difference);
    difference = difference.reshape(1);
    return cv::countNonZero(difference > most);
}

// Rig cameras with a pinhole lens must give the images of the planned camera and of the stereo
// pair's right camera, although they are made in another way.
TEST_F(RigGl, PinholesAreThePlannedCameraAndTheStereoPairsRightOne) {
    RigCamera same = cameraOf("same", Lens::Pinhole), right = cameraOf("right", Lens::Pinhole);
    right.right_m = 0.1;  // the pair's baseline
    exportRig({same, right}, fixture::circle(3),
              {"rgb", "depth", "instance", "normal_world", "rgb_right", "depth_right"});
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_EQ(differing(rigImage("same", "rgb", frame), image("rgb", frame), 0), 0);
        EXPECT_EQ(differing(rigImage("right", "rgb", frame), image("rgb_right", frame), 0), 0);
        // Rasterization rounds corners to fractions of a pixel.
        const int few = 160 * 120 / 500;
        EXPECT_LE(differing(rigImage("same", "instance", frame), image("instance", frame), 0), few);
        EXPECT_LE(differing(rigImage("same", "depth", frame), image("depth", frame), 1), few);
        EXPECT_LE(differing(rigImage("right", "depth", frame), image("depth_right", frame), 1),
                  few);
        EXPECT_LE(
            differing(rigImage("same", "normal_world", frame), image("normal_world", frame), 655),
            3 * few);
        EXPECT_GT(differing(rigImage("same", "rgb", frame), image("rgb_right", frame), 8), 500);
    }
}

TEST_F(RigGl, TheCardSaysLensAndPoses) {
    RigCamera side = cameraOf("side", Lens::Fisheye);
    side.right_m = 0.2;
    side.yaw_deg = 90.0;
    side.k1 = 0.02;
    const Trajectory trajectory = fixture::circle(3);
    exportRig({side}, trajectory, {"rgb"});
    const nlohmann::json written = card();
    EXPECT_EQ(written["modalities"], nlohmann::json({"rgb", "cameras"}));
    const auto& camera = written["cameras"][0];
    EXPECT_EQ(camera["lens"], "fisheye");
    EXPECT_EQ(camera["depth"]["kind"], "range");
    EXPECT_EQ(camera["intrinsics"]["k1"], 0.02);
    ASSERT_EQ(camera["poses"].size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const Pose& planned = trajectory.frames[i].pose;
        const auto p = camera["poses"][i]["position"].get<std::array<double, 3>>();
        const auto q = camera["poses"][i]["quaternion_xyzw"].get<std::array<double, 4>>();
        const Vector3d to_right = planned.rotation * Vector3d::UnitX();
        EXPECT_TRUE(Vector3d(p.data()).isApprox(planned.position + 0.2 * to_right, 1e-12));
        const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
        EXPECT_TRUE((rotation * Vector3d::UnitZ()).isApprox(to_right, 1e-12));
        EXPECT_TRUE(
            (rotation * Vector3d::UnitY()).isApprox(planned.rotation * Vector3d::UnitY(), 1e-12));
    }
}

TEST_F(RigGl, AreNamedOnlyWithARig) {
    DatasetSettings settings;
    settings.folder = folder_ / "out";
    settings.modalities = {"rgb", "cameras"};
    const Status refused = checkSettings(settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
    EXPECT_NE(refused.error().message.find("--rig"), std::string::npos);
    settings.rig = {cameraOf("a", Lens::Pinhole)};
    EXPECT_TRUE(checkSettings(settings));
    settings.rig.push_back(settings.rig.front());
    EXPECT_FALSE(checkSettings(settings));
    settings.rig.clear();
    settings.modalities = {"all"};
    EXPECT_TRUE(checkSettings(settings));
}

// Files of an earlier rig are removed when another dataset replaces it in the folder.
TEST_F(RigGl, AnotherRigLeavesNothingOfTheOneBefore) {
    exportRig({cameraOf("old", Lens::Pinhole)}, fixture::circle(2), {"rgb"});
    ASSERT_TRUE(fs::exists(folder_ / "out/cameras/old/rgb/000001.png"));
    DatasetSettings settings;
    settings.folder = folder_ / "out";
    settings.modalities = {"rgb"};
    settings.overwrite = true;
    settings.rig = {cameraOf("new", Lens::Pinhole)};
    ASSERT_TRUE(exportWith(settings, fixture::circle(1)));
    EXPECT_FALSE(fs::exists(folder_ / "out/cameras/old"));
    EXPECT_TRUE(fs::exists(folder_ / "out/cameras/new/rgb/000000.png"));
    settings.rig.clear();
    ASSERT_TRUE(exportWith(settings, fixture::circle(1)));
    EXPECT_FALSE(fs::exists(folder_ / "out/cameras"));
}

TEST_F(RigGl, WarnsOfCamerasInThings) {
    emptyRoom();
    const Trajectory trajectory = one({1.0, 2.0, 1.2}, {0.0, 2.0, 1.2});  // 1 m in front of a wall
    DatasetContents contents{scene_, smallCamera(), {}, {}};
    contents.frames.resize(1);
    contents.frames[0].camera = trajectory.frames[0];
    contents.frames[0].source_frame = 7;
    const MovingObjects moving(scene_, rays_, {});
    RigCamera camera = cameraOf("probe", Lens::Pinhole);
    const auto warned = [&](double forward_m) {
        camera.forward_m = forward_m;
        contents.rig = {camera};
        const auto warnings = rigWarnings({contents, moving});
        return warnings.empty() ? std::string() : warnings.front();
    };
    EXPECT_EQ(warned(0.0), "");
    EXPECT_EQ(warned(0.8), "");
    EXPECT_NE(warned(0.95).find("closer than 0.1 m"), std::string::npos) << warned(0.95);
    const std::string behind = warned(1.2);
    EXPECT_NE(behind.find("behind"), std::string::npos) << behind;
    EXPECT_NE(behind.find("frame 7: 'wall"), std::string::npos) << behind;
}

/// Renders the furnished room, with its light, through any lens.
class LensPicturesGl : public RigGl {
  protected:
    void SetUp() override {
        RigGl::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        LightVolumeParams params;
        params.max_cells = 3000;
        auto renderer = SceneRenderer::create(
            scene_, bakeLightVolume(scene_, rays_, makeLightRig(scene_, rays_), params));
        ASSERT_TRUE(renderer) << describe(renderer.error());
        renderer_.emplace(std::move(*renderer));
    }
    void TearDown() override {
        renderer_.reset();
        RigGl::TearDown();
    }
    cv::Mat draw(const RigCamera& camera, const Pose& pose, double turned = 0.0) {
        const Eigen::Quaterniond sides(
            Eigen::AngleAxisd(turned, Vector3d(1.0, 2.0, 0.5).normalized()));
        LensPictures pictures(0.05, PictureParams(), sides);
        std::vector<std::uint8_t> rgb;
        const Status status = pictures.draw(LensModel(camera), pose, *renderer_, rays_, rgb);
        EXPECT_TRUE(status);
        return cv::Mat(camera.height_px, camera.width_px, CV_8UC3, rgb.data()).clone();
    }
    std::optional<SceneRenderer> renderer_;
};

struct Off {
    double mean = 0.0;
    double share = 0.0;  // share of pixels that differ by more than 12 of 255
};
Off off(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat difference;
    cv::absdiff(a, b, difference);
    return {cv::mean(difference.reshape(1))[0], cv::countNonZero(difference.reshape(1) > 12) /
                                                    static_cast<double>(difference.total() * 3)};
}

// The borders between the sides of the cube map must be invisible: with a turned cube they are
// elsewhere, and the image is the same except for resampling.
TEST_F(LensPicturesGl, BordersOfTheSidesDoNotShow) {
    const Pose pose = lookAt({1.9, 1.3, 1.4}, {3.5, 1.6, 0.8});
    for (const Lens lens : {Lens::Equirectangular, Lens::Fisheye}) {
        RigCamera camera = cameraOf("a", lens);
        camera.width_px *= 2;
        camera.height_px *= 2;
        camera.fov_deg = 200.0;
        const cv::Mat plain = draw(camera, pose), turned = draw(camera, pose, 0.7);
        const Off seams = off(plain, turned);
        EXPECT_LT(seams.mean, 0.4) << lensName(lens);
        EXPECT_LT(seams.share, 0.0005) << lensName(lens);
        EXPECT_GT(differing(plain, turned, 0), 100) << "the cube did not turn";
        // A shift by one pixel differs far more.
        Pose aside = pose;
        aside.rotation = pose.rotation * Eigen::AngleAxisd(0.02, Vector3d::UnitY());
        const Off moved = off(plain, draw(camera, aside));
        EXPECT_GT(moved.mean, 2.0 * seams.mean) << lensName(lens);
        EXPECT_GT(moved.share, 10.0 * seams.share) << lensName(lens);
    }
}

// Around its poles a panorama stretches the sides of its cube map; edges must not be jagged there.
// The reference is a panorama four times as fine, scaled down.
TEST_F(LensPicturesGl, EdgesHaveNoTeethAroundThePoles) {
    const Pose pose = lookAt({1.9, 1.3, 1.4}, {3.5, 1.6, 0.3});
    RigCamera camera = cameraOf("a", Lens::Equirectangular);
    const cv::Rect lower(0, 96, 256, 32);  // from 45 degrees down
    const auto drawLower = [&] { return draw(camera, pose)(lower).clone(); };
    const cv::Mat found = drawLower();
    camera.width_px *= 4;
    camera.height_px *= 4;
    cv::Mat fine, truth;
    draw(camera, pose).convertTo(fine, CV_64F, 1.0 / 255.0);
    cv::pow(fine, 2.2, fine);
    cv::resize(fine, fine, {256, 128}, 0.0, 0.0, cv::INTER_AREA);
    cv::pow(fine, 1.0 / 2.2, fine);
    fine(lower).convertTo(truth, CV_8U, 255.0);
    const double teeth = off(found, truth).mean;
    EXPECT_LT(teeth, 0.55);  // sides only as fine as the equator needs give 0.68
    // An image half as fine differs more.
    camera.width_px = 128;
    camera.height_px = 64;
    cv::Mat coarse;
    cv::resize(draw(camera, pose), coarse, {256, 128}, 0.0, 0.0, cv::INTER_LINEAR);
    EXPECT_GT(off(coarse(lower), truth).mean, 2.0 * teeth);
}

// The image of a narrow fisheye lens, looked up pixel by pixel in a pinhole image of the same room.
TEST_F(LensPicturesGl, ResampledPicturesShowWhatPinholesShow) {
    const Pose pose = lookAt({1.9, 1.3, 1.4}, {3.5, 1.6, 0.8});
    RigCamera narrow = cameraOf("a", Lens::Fisheye), pinhole = cameraOf("b", Lens::Pinhole);
    narrow.fov_deg = 60.0;
    pinhole.fov_deg = 62.0;
    pinhole.width_px = pinhole.height_px = 640;
    const cv::Mat bent = draw(narrow, pose), straight = draw(pinhole, pose);
    const LensModel from(narrow), to(pinhole);
    int seen = 0, far_off = 0;
    for (int y = 0; y < narrow.height_px; ++y) {
        for (int x = 0; x < narrow.width_px; ++x) {
            const auto ray = from.ray(x + 0.5, y + 0.5);
            if (!ray) continue;
            const Eigen::Vector2d at = *to.project(ray->direction);
            const auto expected =
                straight.at<cv::Vec3b>(static_cast<int>(at.y()), static_cast<int>(at.x()));
            const cv::Vec3b found = bent.at<cv::Vec3b>(y, x);
            ++seen;
            for (int c = 0; c < 3; ++c) {
                if (std::abs(int{expected[c]} - int{found[c]}) > 24) {
                    ++far_off;
                    break;
                }
            }
        }
    }
    EXPECT_GT(seen, 19000);
    EXPECT_LT(far_off, seen / 25);  // edges
}

// Only the sides that a lens needs, and none coarser than it needs.
TEST(LensSides, AreThoseThatTheLensSees) {
    const LensPictures pictures(0.05, PictureParams());
    const auto count = [&](Lens lens, double fov_deg) {
        RigCamera camera = cameraOf("a", lens);
        camera.fov_deg = fov_deg;
        const LensModel model(camera);
        const auto sides = pictures.sidesFor(model);
        for (const LensPictures::Side& side : sides) {
            EXPECT_GE(0.5 * side.size_px / side.reach, 0.999 * model.mostPxPerRadian());
        }
        return sides.size();
    };
    EXPECT_EQ(count(Lens::Fisheye, 60.0), 1U);
    EXPECT_EQ(count(Lens::Fisheye, 100.0), 1U);
    EXPECT_EQ(count(Lens::Fisheye, 180.0), 5U);
    EXPECT_EQ(count(Lens::Equirectangular, 60.0), 6U);
}

}  // namespace
}  // namespace dollytrack::render::rig_gl_test
