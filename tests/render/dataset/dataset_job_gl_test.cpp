#include "render/dataset/dataset_job.h"

#include "engine/camera/intrinsics.h"
#include "engine/io/files/sha256.h"
#include "engine/jobs/parallel.h"
#include "render/frames/mask_rle.h"
#include "tests/render/dataset/dataset_fixture.h"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

namespace dollytrack::render::dataset_job_gl_test {
namespace {

namespace fs = std::filesystem;
using fixture::circle;
using fixture::smallCamera;

class DatasetJobGl : public fixture::DatasetGlTest {};

TEST_F(DatasetJobGl, WritesADatasetThatAgreesWithItself) {
    const Trajectory trajectory = circle(7);
    const fs::path out = folder_ / "new" / "dataset";
    const auto summary = exportTo(out, trajectory);
    ASSERT_TRUE(summary) << describe(summary.error());
    EXPECT_EQ(summary->frames, 7);
    EXPECT_FALSE(fs::exists(out / ".dollytrack-export"));

    const auto card = nlohmann::json::parse(read(out / "dataset.json"));
    // All other files, and only these, are listed with their hashes.
    auto files = tree(out);
    files.erase("dataset.json");
    EXPECT_EQ(files.size(), 7U * 4 + 5);
    ASSERT_EQ(card.at("files").size(), files.size());
    for (const auto& [name, bytes] : files) {
        EXPECT_EQ(card.at("files").at(name), sha256Of(std::string_view(bytes))) << name;
    }

    // COCO masks are the instance image's pixels.
    const auto coco = nlohmann::json::parse(read(out / "annotations.json"));
    ASSERT_EQ(coco.at("images").size(), 7U);
    ASSERT_GT(coco.at("annotations").size(), 7U);
    int expected_id = 1;
    for (const auto& annotation : coco.at("annotations")) {
        EXPECT_EQ(annotation.at("id"), expected_id++);
        const int frame = annotation.at("image_id").get<int>() - 1;
        const int object = annotation.at("object_id");
        EXPECT_EQ(scene_.object(object).role, Role::Target);
        EXPECT_EQ(annotation.at("category_id"), scene_.object(object).nyu40);
        char name[32];
        std::snprintf(name, sizeof name, "instance/%06d.png", frame);
        const cv::Mat ids = cv::imread((out / name).string(), cv::IMREAD_UNCHANGED);
        ASSERT_EQ(ids.type(), CV_16UC1);
        const auto counts =
            decompressCounts(annotation.at("segmentation").at("counts").get<std::string>());
        std::size_t place = 0;
        int wrong = 0;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            for (std::uint32_t k = 0; k < counts[i]; ++k, ++place) {
                const int y = static_cast<int>(place) % ids.rows;
                const int x = static_cast<int>(place) / ids.rows;
                wrong += (ids.at<std::uint16_t>(y, x) == object) != (i % 2 == 1) ? 1 : 0;
            }
        }
        EXPECT_EQ(place, ids.total());
        EXPECT_EQ(wrong, 0);
    }

    // A pixel that is unprojected by the conventions in dataset.json lies on its object.
    const auto& lens = card.at("conventions").at("intrinsics");
    const auto& row = card.at("frames").at(3);
    const Eigen::Quaterniond rotation(
        row.at("quaternion_xyzw").at(3), row.at("quaternion_xyzw").at(0),
        row.at("quaternion_xyzw").at(1), row.at("quaternion_xyzw").at(2));
    const Eigen::Vector3d position(row.at("position").at(0), row.at("position").at(1),
                                   row.at("position").at(2));
    const cv::Mat depth = cv::imread((out / "depth/000003.png").string(), cv::IMREAD_UNCHANGED);
    const cv::Mat ids = cv::imread((out / "instance/000003.png").string(), cv::IMREAD_UNCHANGED);
    const cv::Mat classes =
        cv::imread((out / "semantic/000003.png").string(), cv::IMREAD_UNCHANGED);
    for (int y = 5; y < depth.rows; y += 10) {
        for (int x = 5; x < depth.cols; x += 10) {
            const double z = depth.at<std::uint16_t>(y, x) * 0.001;
            ASSERT_GT(z, 0.0);
            const Eigen::Vector3d in_camera(
                (x + 0.5 - lens.at("cx").get<double>()) / lens.at("fx").get<double>() * z,
                (y + 0.5 - lens.at("cy").get<double>()) / lens.at("fy").get<double>() * z, z);
            const Eigen::Vector3d point = rotation * in_camera + position;
            const ClosestPoint closest = rays_.closest(point);
            EXPECT_LT(closest.distance, 0.002);
            EXPECT_EQ(classes.at<std::uint8_t>(y, x),
                      scene_.object(ids.at<std::uint16_t>(y, x)).nyu40);
        }
    }
}

TEST_F(DatasetJobGl, GivesTheSameBytesWhateverTheThreads) {
    ASSERT_TRUE(exportTo(folder_ / "a", circle(4)));
    setThreadCount(1);
    const auto second = exportTo(folder_ / "b", circle(4));
    setThreadCount(0);
    ASSERT_TRUE(second);
    EXPECT_TRUE(tree(folder_ / "a") == tree(folder_ / "b"));
}

// Without colour images no light is computed; everything else is the same.
TEST_F(DatasetJobGl, OtherImagesDoNotDependOnLight) {
    DatasetSettings settings;
    settings.formats = {"coco"};
    settings.folder = folder_ / "lit";
    settings.modalities = {"rgb", "depth", "instance", "normal_camera", "albedo"};
    ASSERT_TRUE(exportWith(settings, circle(3)));
    settings.folder = folder_ / "unlit";
    settings.modalities.erase(settings.modalities.begin());
    ASSERT_TRUE(exportWith(settings, circle(3)));
    const auto lit = tree(folder_ / "lit");
    int compared = 0;
    for (const auto& [name, bytes] : tree(folder_ / "unlit")) {
        if (!name.ends_with(".png")) continue;
        EXPECT_TRUE(lit.at(name) == bytes) << name;
        ++compared;
    }
    EXPECT_EQ(compared, 4 * 3);
}

TEST_F(DatasetJobGl, ReplacesItsOwnLongerDatasetCompletely) {
    ASSERT_TRUE(exportTo(folder_ / "a", circle(5)));
    const auto before = tree(folder_ / "a");
    const auto refused = exportTo(folder_ / "a", circle(3));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
    EXPECT_NE(refused.error().message.find("complete dataset of 5 frames"), std::string::npos)
        << refused.error().message;
    EXPECT_EQ(tree(folder_ / "a"), before);
    ASSERT_TRUE(exportTo(folder_ / "a", circle(3), true));
    ASSERT_TRUE(exportTo(folder_ / "b", circle(3)));
    EXPECT_TRUE(tree(folder_ / "a") == tree(folder_ / "b"));
}

TEST_F(DatasetJobGl, RefusesAForeignFolderUnlessTold) {
    std::ofstream(folder_ / "thesis.txt") << "mine";
    const auto refused = exportTo(folder_, circle(2));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::CannotWrite);
    EXPECT_EQ(tree(folder_).size(), 1U);
    ASSERT_TRUE(exportTo(folder_, circle(2), true));
    EXPECT_EQ(read(folder_ / "thesis.txt"), "mine");
}

TEST_F(DatasetJobGl, AFileInTheFoldersPlaceIsNamed) {
    std::ofstream(folder_ / "out") << "x";
    const auto refused = exportTo(folder_ / "out", circle(2));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::CannotWrite);
    EXPECT_NE(refused.error().where.find("out"), std::string::npos);
}

TEST_F(DatasetJobGl, AFolderInTheWayOfAPictureIsSaidBeforeTheOldDatasetIsTouched) {
    fs::create_directories(folder_ / "out");
    const auto first = exportTo(folder_ / "out", circle(2));
    ASSERT_TRUE(first);
    // A folder in the place of an image makes writing fail even for root, whom permissions do not
    // stop.
    fs::remove(folder_ / "out/rgb/000001.png");
    fs::create_directories(folder_ / "out/rgb/000001.png/full");
    const auto before = tree(folder_ / "out");
    const auto failed = exportTo(folder_ / "out", circle(2), true);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::CannotWrite);
    EXPECT_NE(failed.error().where.find("000001.png"), std::string::npos);
    EXPECT_EQ(tree(folder_ / "out"), before);
}

TEST_F(DatasetJobGl, CancellingLeavesWholeImagesAndNoCard) {
    auto cancel = std::make_shared<std::atomic<bool>>(false);
    constexpr int kFrames = 12;
    const JobContext job(cancel, {}, [&](int done, int total) {
        if (total == kFrames && done >= kFrames / 2) *cancel = true;
    });
    const auto stopped = exportTo(folder_ / "out", circle(kFrames), false, job);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
    const auto files = tree(folder_ / "out");
    EXPECT_GT(files.size(), 4U);
    for (const auto& [name, bytes] : files) {
        EXPECT_EQ(name.find(".tmp."), std::string::npos);
        if (name.ends_with(".png")) {
            EXPECT_FALSE(cv::imread((folder_ / "out" / name).string()).empty()) << name;
        }
    }
    EXPECT_EQ(files.count("dataset.json"), 0U);
}

// The captures counted by pixels must match a count by rays.
TEST_F(DatasetJobGl, CapturesMatchACountByRays) {
    const Trajectory trajectory = circle(6);
    const auto summary = exportTo(folder_ / "out", trajectory);
    ASSERT_TRUE(summary);
    const Intrinsics lens = makeIntrinsics(smallCamera());
    std::vector<ObjectView> views;
    for (int f = 0; f < 6; ++f) {
        const Pose& pose = trajectory.frames[f].pose;
        for (const Object& object : scene_.objects) {
            int visible = 0, whole = 0, x0 = 999, x1 = -1, y0 = 999, y1 = -1;
            for (int y = -360; y < 480; ++y) {
                for (int x = -480; x < 640; ++x) {
                    if (object.role != Role::Target) continue;
                    const Eigen::Vector3d way = pose.rotation * lens.unproject(x + 0.5, y + 0.5);
                    if (!rays_.meetsObject(object.id, pose.position, way)) continue;
                    ++whole;
                    if (x < 0 || y < 0 || x >= 160 || y >= 120) continue;
                    if (rays_.cast(pose.position, way).object_id != object.id) continue;
                    ++visible;
                    x0 = std::min(x0, x);
                    x1 = std::max(x1, x);
                    y0 = std::min(y0, y);
                    y1 = std::max(y1, y);
                }
            }
            if (visible == 0) continue;
            views.push_back({object.id, f, double(visible) / whole, visible * 16.0,
                             (x1 - x0 + 1.0) * (y1 - y0 + 1.0) / 19200.0, visible / 19200.0});
        }
    }
    const auto expected = bestCaptures(scene_, views);
    ASSERT_EQ(expected.size(), summary->captures.size());
    int captured = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const ObjectCapture& counted = summary->captures[i];
        EXPECT_EQ(counted.captured, expected[i].captured);
        EXPECT_EQ(counted.well_captured, expected[i].well_captured);
        if (!expected[i].captured) continue;
        ++captured;
        EXPECT_NEAR(counted.best.visible_fraction, expected[i].best.visible_fraction, 0.02);
        EXPECT_NEAR(counted.best.mask_share, expected[i].best.mask_share,
                    0.02 * expected[i].best.mask_share + 1e-3);
    }
    EXPECT_GE(captured, 2);
}

}  // namespace
}  // namespace dollytrack::render::dataset_job_gl_test
