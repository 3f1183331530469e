#include "engine/camera/lens_model.h"

#include "engine/io/settings/rig_file.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <numbers>

namespace dollytrack::lens_model_test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<RigCamera> allLenses() {
    std::vector<RigCamera> cameras;
    for (const Lens lens :
         {Lens::Pinhole, Lens::Fisheye, Lens::Equirectangular, Lens::Orthographic}) {
        cameras.push_back(standardCamera(lens));
    }
    RigCamera bent = standardCamera(Lens::Fisheye);
    bent.width_px = 640;
    bent.height_px = 480;
    bent.fov_deg = 210.0;
    bent.k1 = -0.03;
    bent.k2 = 0.004;
    bent.k3 = -0.0008;
    bent.k4 = 0.00005;
    cameras.push_back(bent);
    RigCamera flat = standardCamera(Lens::Equirectangular);
    flat.width_px = 300;
    flat.height_px = 200;
    cameras.push_back(flat);
    for (RigCamera& camera : cameras) camera.name = "one";
    return cameras;
}

// Every image position has a ray that is projected back to it, or is outside the image circle.
TEST(LensModel, ProjectsEachRayBackToItsPixel) {
    for (const RigCamera& camera : allLenses()) {
        ASSERT_TRUE(validate(Rig{camera})) << lensName(camera.lens);
        const LensModel lens(camera);
        int seen = 0, all = 0;
        for (double y = 0.5; y < camera.height_px; y += 3.7) {
            for (double x = 0.5; x < camera.width_px; x += 3.3) {
                ++all;
                const auto ray = lens.ray(x, y);
                const double r = std::hypot(x - 0.5 * camera.width_px, y - 0.5 * camera.height_px);
                const bool inside = camera.lens != Lens::Fisheye || r <= 0.5 * camera.width_px;
                ASSERT_EQ(ray.has_value(), inside) << lensName(camera.lens) << x << " " << y;
                if (!ray) continue;
                ++seen;
                for (const double far : {0.3, 7.0}) {
                    const auto back = lens.project(ray->origin + far * ray->direction);
                    ASSERT_TRUE(back) << lensName(camera.lens) << x << " " << y;
                    EXPECT_NEAR(back->x(), x, 1e-8) << lensName(camera.lens);
                    EXPECT_NEAR(back->y(), y, 1e-8) << lensName(camera.lens);
                }
            }
        }
        EXPECT_GT(seen, all / 2);
    }
}

TEST(LensModel, LengthsAlongRaysAreTheDepthsSaid) {
    for (const RigCamera& camera : allLenses()) {
        const LensModel lens(camera);
        const auto ray = lens.ray(0.7 * camera.width_px, 0.4 * camera.height_px);
        ASSERT_TRUE(ray);
        const double unit = lens.measuresRange() ? ray->direction.norm() : ray->direction.z();
        EXPECT_NEAR(unit, 1.0, 1e-12) << lensName(camera.lens);
    }
}

// Computed by hand from the formulas in dataset.json.
TEST(LensModel, SeesKnownDirectionsAtKnownPlaces) {
    const LensModel sphere(standardCamera(Lens::Equirectangular));  // 1024 x 512
    const auto at = [](const LensModel& lens, double x, double y, double z) {
        const auto place = lens.project({x, y, z});
        return place ? *place : Eigen::Vector2d(-1e9, -1e9);
    };
    EXPECT_TRUE(at(sphere, 0, 0, 1).isApprox(Eigen::Vector2d(512, 256)));
    EXPECT_TRUE(at(sphere, 1, 0, 0).isApprox(Eigen::Vector2d(768, 256)));  // right
    EXPECT_TRUE(at(sphere, -1, 0, 0).isApprox(Eigen::Vector2d(256, 256)));
    EXPECT_NEAR(at(sphere, 0, 1, 1e-12).y(), 512.0, 1e-9);                  // down
    EXPECT_TRUE(at(sphere, 0, -1, 1).isApprox(Eigen::Vector2d(512, 128)));  // 45 degrees up

    const LensModel half(standardCamera(Lens::Fisheye));  // 640 x 640, 180 degrees
    EXPECT_NEAR(half.focal(), 320.0 / (kPi / 2), 1e-9);
    EXPECT_TRUE(at(half, 1, 0, 1).isApprox(Eigen::Vector2d(480, 320)));  // half way out
    EXPECT_NEAR(at(half, 0, 1, 0).y(), 640.0, 1e-9);
    EXPECT_FALSE(half.project({1, 0, -0.01}));  // behind

    RigCamera drawing = standardCamera(Lens::Orthographic);
    drawing.px_per_m = 50.0;
    const LensModel parallel(drawing);
    EXPECT_TRUE(at(parallel, 1, -2, 3).isApprox(Eigen::Vector2d(370, 140)));
    EXPECT_TRUE(at(parallel, 1, -2, 9).isApprox(Eigen::Vector2d(370, 140)));
    EXPECT_FALSE(parallel.project({0, 0, -1}));
}

// The smallest angle between neighbouring rays agrees with the lens's resolution, up to the step
// size.
TEST(LensModel, SaysHowFineItsPictureIs) {
    for (const RigCamera& camera : allLenses()) {
        if (camera.lens == Lens::Orthographic) continue;
        const LensModel lens(camera);
        double most = 0.0;
        for (double y = 1.0; y < camera.height_px - 1.0; y += 5.0) {
            for (double x = 1.0; x < camera.width_px - 1.0; x += 5.0) {
                const auto here = lens.ray(x, y), below = lens.ray(x, y + 1e-3);
                if (!here || !below) continue;
                const double angle =
                    here->direction.normalized().cross(below->direction.normalized()).norm();
                most = std::max(most, 1e-3 / angle);
            }
        }
        EXPECT_LE(most, 1.001 * lens.mostPxPerRadian()) << lensName(camera.lens);
        if (camera.lens != Lens::Equirectangular) {
            EXPECT_GE(most, 0.7 * lens.mostPxPerRadian()) << lensName(camera.lens);
        }
    }
}

TEST(Rig, RefusesLensesThatCannotBe) {
    RigCamera camera = standardCamera(Lens::Fisheye);
    camera.name = "wide";
    EXPECT_TRUE(validate(Rig{camera}));
    camera.k1 = -0.3;  // decreases from t = 1.05
    const Status falls = validate(Rig{camera});
    ASSERT_FALSE(falls);
    EXPECT_NE(falls.error().where.find("wide"), std::string::npos);
    camera.fov_deg = 100.0;  // ends before that
    EXPECT_TRUE(validate(Rig{camera}));
    // Its edge would have thousands of pixels per radian, or many more than its middle.
    RigCamera stretched = standardCamera(Lens::Fisheye);
    stretched.name = "stretched";
    stretched.width_px = stretched.height_px = 4096;
    EXPECT_TRUE(validate(Rig{stretched}));
    stretched.k1 = stretched.k2 = 10.0;
    EXPECT_FALSE(validate(Rig{stretched}));
    stretched.width_px = stretched.height_px = 640;
    EXPECT_FALSE(validate(Rig{stretched}));
    stretched.k1 = stretched.k2 = 0.2;
    EXPECT_TRUE(validate(Rig{stretched}));
    RigCamera pinhole;
    pinhole.name = "wide";
    pinhole.fov_deg = 170.0;
    EXPECT_FALSE(validate(Rig{pinhole}));
    pinhole.fov_deg = 90.0;
    EXPECT_TRUE(validate(Rig{pinhole}));
    EXPECT_FALSE(validate(Rig{pinhole, camera}));  // equal names
    for (const char* const name : {"", "..", "a/b", "a b", "-x", "\xC3\xA4"}) {
        pinhole.name = name;
        EXPECT_FALSE(validate(Rig{pinhole})) << name;
    }
}

// Computed by hand: the right of a camera that looks along +x (world, z up) is -y.
TEST(Rig, CarriesCamerasWhereTheySay) {
    const Pose planned = lookAt({1, 2, 1.5}, {5, 2, 1.5});
    RigCamera camera;
    EXPECT_TRUE(poseOnRig(camera, planned) == planned);
    camera.right_m = 0.1;
    camera.down_m = 0.2;
    camera.forward_m = 0.3;
    camera.yaw_deg = 90.0;
    Pose pose = poseOnRig(camera, planned);
    EXPECT_TRUE(pose.position.isApprox(Eigen::Vector3d(1.3, 1.9, 1.3), 1e-12));
    EXPECT_TRUE(pose.forward().isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
    camera.yaw_deg = 0.0;
    camera.pitch_deg = 30.0;  // up
    EXPECT_NEAR(poseOnRig(camera, planned).forward().z(), 0.5, 1e-12);
    camera.pitch_deg = 0.0;
    camera.roll_deg = 90.0;  // its x axis goes down
    pose = poseOnRig(camera, planned);
    EXPECT_TRUE((pose.rotation * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitZ()));
}

TEST(Rig, LevelCamerasKeepTheHeadingAlone) {
    RigCamera camera;
    camera.level = true;
    camera.down_m = 1.0;
    const Eigen::Vector3d eye(1, 2, 1.5);
    for (const Eigen::Vector3d& target :
         {Eigen::Vector3d(4, 3, 0.2), Eigen::Vector3d(-1, 5, 2.4), Eigen::Vector3d(1, 2, 0)}) {
        const Pose planned = lookAt(eye, target);
        const Pose pose = poseOnRig(camera, planned);
        EXPECT_NEAR(pose.forward().z(), 0.0, 1e-12);
        EXPECT_TRUE(
            (pose.rotation * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
        EXPECT_TRUE(pose.position.isApprox(Eigen::Vector3d(1, 2, 0.5), 1e-12));
        const Eigen::Vector3d ahead = target - eye;
        if (ahead.head<2>().norm() > 0.1) {
            EXPECT_GT(pose.forward().head<2>().dot(ahead.head<2>().normalized()), 1.0 - 1e-9);
        }
    }
}

class RigFile : public ::testing::Test {
  protected:
    Result<Rig> read(const std::string& text) {
        const auto file = folder_.path() / "rig.json";
        std::ofstream(file) << text;
        return readRig(file);
    }
    static std::string with(const std::string& cameras) {
        return R"({"format": "dollytrack-rig", "version": 1, "cameras": [)" + cameras + "]}";
    }
    test::TempFolder folder_;
};

TEST_F(RigFile, ReadsWhatItSays) {
    const auto rig = read(with(R"({"name": "front"},
        {"name": "left", "lens": "fisheye", "fov_deg": 200, "k1": 0.01, "yaw_deg": -90,
         "right_m": -0.05, "level": true},
        {"name": "all", "lens": "equirectangular"})"));
    ASSERT_TRUE(rig) << describe(rig.error());
    ASSERT_EQ(rig->size(), 3U);
    EXPECT_EQ((*rig)[0].lens, Lens::Pinhole);
    EXPECT_EQ((*rig)[1].fov_deg, 200.0);
    EXPECT_EQ((*rig)[1].right_m, -0.05);
    EXPECT_TRUE((*rig)[1].level);
    EXPECT_EQ((*rig)[2].width_px, 1024);
    EXPECT_EQ((*rig)[2].height_px, 512);
}

TEST_F(RigFile, RefusesWithTheSentenceAndThePlace) {
    const auto refusal = [&](const std::string& text) {
        const auto rig = read(text);
        return rig ? "nothing" : describe(rig.error());
    };
    const struct {
        const char* camera;
        const char* word;
        const char* place;
    } cases[] = {
        {R"({"name": "a", "fov": 90})", "fov_deg", "cameras[0]"},
        {R"({"name": "a", "fov_deg": 900})", "10 .. 220", "cameras[0].fov_deg"},
        {R"({"name": "a", "lens": "fisheye", "px_per_m": 9})", "does not apply",
         "cameras[0].px_per_m"},
        {R"({"name": "a", "lens": "bottle"})", "fisheye", "cameras[0].lens"},
        {R"({"name": "a/b"})", "folder", "cameras[0]"},
        {R"({"name": "a"}, {"name": "a"})", "same name", "cameras[1]"},
        {R"({"lens": "fisheye"})", "text", "cameras[0].name"},
        {R"(7)", "object", "cameras[0]"},
    };
    for (const auto& one : cases) {
        const std::string said = refusal(with(one.camera));
        EXPECT_NE(said.find(one.word), std::string::npos) << said;
        EXPECT_NE(said.find(one.place), std::string::npos) << said;
    }
    EXPECT_NE(refusal(with("")).find("at least one camera"), std::string::npos);
    EXPECT_NE(refusal("[]").find("A rig is an object"), std::string::npos);
    EXPECT_NE(refusal(R"({"format": "x", "version": 1, "cameras": []})").find("dollytrack-rig"),
              std::string::npos);
    EXPECT_EQ(refusal(with(R"({"name": "a"})")), "nothing");
}

TEST(RigWords, MakeTheCameraThatAFileMakes) {
    const auto camera = parseRigCamera("left:fov_deg=200,lens=fisheye,k1=0.01,level=true");
    ASSERT_TRUE(camera) << describe(camera.error());
    RigCamera expected = standardCamera(Lens::Fisheye);
    expected.name = "left";
    expected.fov_deg = 200.0;
    expected.k1 = 0.01;
    expected.level = true;
    EXPECT_TRUE(*camera == expected);
    EXPECT_TRUE(parseRigCamera("plain"));
    for (const char* const wrong :
         {"", "a:lens=egg", "a:fov_deg=x", "a:px_per_m=3", "a:focus=2", "a:fov_deg"}) {
        const auto none = parseRigCamera(wrong);
        ASSERT_FALSE(none) << wrong;
        EXPECT_EQ(none.error().code, ErrorCode::Usage);
    }
}

}  // namespace
}  // namespace dollytrack::lens_model_test
