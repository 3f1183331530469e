#include "render/dataset/contents/frame_context.h"
#include "render/encoders/modalities.h"
#include "render/frames/frame_file.h"
#include "tests/render/dataset/dataset_fixture.h"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <random>

namespace dollytrack::render::dataset_resume_gl_test {
namespace {

namespace fs = std::filesystem;
using fixture::circle;
using fixture::smallCamera;

constexpr const char* kMark = ".dollytrack-export";

class DatasetResumeGl : public fixture::DatasetGlTest {
  protected:
    static DatasetSettings settingsFor(const fs::path& folder, bool resume = true) {
        DatasetSettings settings;
        settings.folder = folder;
        settings.resume = resume;
        return settings;
    }

    /// Exports and cancels after `frames` were rendered, so that a partial dataset is left.
    void exportPart(const fs::path& folder, const Trajectory& trajectory, int frames) {
        auto cancel = std::make_shared<std::atomic<bool>>(false);
        const JobContext job(cancel, {}, [&](int done, int) { *cancel = done >= frames; });
        const auto stopped = exportWith(settingsFor(folder), trajectory, job);
        ASSERT_FALSE(stopped);
        EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
        EXPECT_NE(stopped.error().message.find("--resume"), std::string::npos);
    }

    /// How many frames an export that continues in the folder renders.
    int framesDrawnBy(const fs::path& folder, const Trajectory& trajectory) {
        int first = -1;
        const JobContext job({}, {}, [&](int done, int) { first = first < 0 ? done : first; });
        const auto summary = exportWith(settingsFor(folder), trajectory, job);
        EXPECT_TRUE(summary) << (summary ? "" : describe(summary.error()));
        return static_cast<int>(trajectory.frames.size()) - first;
    }
};

TEST_F(DatasetResumeGl, EndsWithTheBytesOfAnUnbrokenRun) {
    const Trajectory trajectory = circle(9);
    ASSERT_TRUE(exportTo(folder_ / "unbroken", trajectory));
    const auto expected = tree(folder_ / "unbroken");
    for (const int frames : {0, 1, 4, 8, 9}) {
        const fs::path out = folder_ / std::to_string(frames);
        if (frames > 0) exportPart(out, trajectory, frames);
        EXPECT_EQ(framesDrawnBy(out, trajectory), 9 - frames);
        EXPECT_TRUE(tree(out) == expected) << frames;
    }
}

TEST_F(DatasetResumeGl, RendersAgainWhatIsMissingOrDamaged) {
    const Trajectory trajectory = circle(8);
    ASSERT_TRUE(exportTo(folder_ / "unbroken", trajectory));
    const fs::path out = folder_ / "out";
    exportPart(out, trajectory, 6);
    fs::remove(out / "depth/000002.png");
    const std::string picture = read(out / "rgb/000004.png");
    std::ofstream(out / "rgb/000004.png", std::ios::binary) << picture.substr(0, 500);
    (void)std::ofstream(out / "rgb/000001.png.tmp.99");
    // No frame of this dataset has that number, so the file is not the export's own and is kept.
    (void)std::ofstream(out / "rgb/000099.png");
    EXPECT_EQ(framesDrawnBy(out, trajectory), 4);
    EXPECT_TRUE(fs::remove(out / "rgb/000099.png"));
    EXPECT_TRUE(tree(out) == tree(folder_ / "unbroken"));
}

// The counter asks for fewer silhouettes after better frames; the order in which frames are
// rendered must not change the counts.
TEST_F(DatasetResumeGl, CountsTheSameWhicheverFramesAreMissing) {
    const Trajectory trajectory = circle(10);
    ASSERT_TRUE(exportTo(folder_ / "unbroken", trajectory));
    const auto expected = tree(folder_ / "unbroken");
    std::mt19937 random(7);
    for (int round = 0; round < 6; ++round) {
        const fs::path out = folder_ / std::to_string(round);
        exportPart(out, trajectory, 9);
        for (int i = 0; i < 4; ++i) {
            fs::remove(out / frameFile("instance", static_cast<int>(random() % 10)));
        }
        framesDrawnBy(out, trajectory);
        EXPECT_TRUE(tree(out) == expected) << round;
    }
}

TEST_F(DatasetResumeGl, RefusesToMixTwoDatasets) {
    const Trajectory trajectory = circle(6);
    const fs::path out = folder_ / "out";
    exportPart(out, trajectory, 3);
    const auto before = tree(out);
    const auto refused = [&](DatasetSettings settings, const Trajectory& with, const char* word) {
        const auto result = exportWith(std::move(settings), with);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::Usage);
        EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
        EXPECT_TRUE(tree(out) == before) << word;
    };
    Trajectory moved = trajectory;
    moved.frames[5].pose.position.x() += 1e-9;
    refused(settingsFor(out), moved, "the trajectory");
    DatasetSettings other = settingsFor(out);
    other.modalities = {"rgb"};
    refused(other, trajectory, "the modalities");
    other = settingsFor(out);
    other.range.step = 2;
    refused(other, trajectory, "the frame range");
    other = settingsFor(out);
    other.light.exposure_ev = 0.5;
    refused(other, trajectory, "the light");
    parameters_ = "{}";
    refused(settingsFor(out), trajectory, "the parameters");
    parameters_ = R"({"camera": {"width_px": 160}})";
    scene_.materials[0].base_color.x() *= 0.5F;
    refused(settingsFor(out), trajectory, "the scene");
}

// The camera's curve through the frames of a range depends on the frames around the range, and with
// it motion blur and inertial measurements.
TEST_F(DatasetResumeGl, KnowsTheMotionOutsideOfTheRange) {
    const Trajectory trajectory = circle(8);
    const auto motionsUpTo = [&](double metres) {
        ObjectMotion motion{scene_.objects.back().id, {}};
        for (int i = 0; i < 8; ++i) {
            motion.by_frame.emplace_back(Eigen::Translation3d(i < 7 ? 0.0 : metres, 0.0, 0.0));
        }
        return std::vector{motion};
    };
    const auto settingsOf = [&](const char* name, bool resume) {
        DatasetSettings settings = settingsFor(folder_ / name, resume);
        settings.range = {1, 5, 1};
        settings.modalities = {"rgb_sensor"};
        settings.formats = {"imu"};
        settings.sensor.looks = 2;
        return settings;
    };
    const auto refused = [&](const char* name, const Trajectory& with, const char* word) {
        const auto result = exportWith(settingsOf(name, true), with);
        ASSERT_FALSE(result) << name << " " << word;
        EXPECT_EQ(result.error().code, ErrorCode::Usage);
        EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
    };
    Trajectory elsewhere = trajectory;
    elsewhere.frames[6].pose.position.x() += 0.05;
    motions_ = motionsUpTo(0.1);
    auto cancel = std::make_shared<std::atomic<bool>>(false);
    const JobContext stop(cancel, {}, [&](int done, int) { *cancel = done >= 2; });
    ASSERT_FALSE(exportWith(settingsOf("part", false), trajectory, stop));
    ASSERT_TRUE(exportWith(settingsOf("complete", false), trajectory));
    refused("part", elsewhere, "the trajectory");
    refused("complete", elsewhere, "whole_motion");
    motions_ = motionsUpTo(0.2);
    refused("part", trajectory, "the motions of objects");
    refused("complete", trajectory, "whole_motion");
    motions_ = motionsUpTo(0.1);
    EXPECT_TRUE(exportWith(settingsOf("part", true), trajectory));
    EXPECT_TRUE(exportWith(settingsOf("complete", true), trajectory));
    EXPECT_EQ(tree(folder_ / "part"), tree(folder_ / "complete"));
}

TEST_F(DatasetResumeGl, ACompleteDatasetIsCheckedAndLeftAlone) {
    const Trajectory trajectory = circle(4);
    const fs::path out = folder_ / "out";
    const auto first = exportTo(out, trajectory);
    ASSERT_TRUE(first);
    const auto files = tree(out);
    const auto again = exportWith(settingsFor(out), trajectory);
    ASSERT_TRUE(again) << describe(again.error());
    EXPECT_EQ(again->frames, 4);
    EXPECT_EQ(again->counted.captured, first->counted.captured);
    EXPECT_EQ(again->counted.area_share_mask, first->counted.area_share_mask);
    EXPECT_TRUE(tree(out) == files);

    const auto other = exportWith(settingsFor(out), circle(5));
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::Usage);
    EXPECT_NE(other.error().message.find("frames"), std::string::npos);
    EXPECT_TRUE(tree(out) == files);

    fs::remove(out / "semantic/000003.png");
    const auto damaged = exportWith(settingsFor(out), trajectory);
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().code, ErrorCode::BadInput);
    EXPECT_NE(damaged.error().where.find("000003.png"), std::string::npos);
}

// Killed when dataset.json was written already but the journal was not removed yet.
TEST_F(DatasetResumeGl, EndsWhatWasKilledAtTheVeryEnd) {
    const Trajectory trajectory = circle(4);
    const fs::path out = folder_ / "out";
    exportPart(out, trajectory, 4);
    const std::string journal = read(out / kMark);
    EXPECT_EQ(framesDrawnBy(out, trajectory), 0);
    const auto files = tree(out);
    std::ofstream(out / kMark, std::ios::binary) << journal;
    EXPECT_EQ(framesDrawnBy(out, trajectory), 0);
    EXPECT_TRUE(tree(out) == files);
}

TEST_F(DatasetResumeGl, WithoutResumeAnUnfinishedDatasetBeginsAnew) {
    const Trajectory trajectory = circle(5);
    const fs::path out = folder_ / "out";
    exportPart(out, trajectory, 3);
    ASSERT_TRUE(exportTo(folder_ / "unbroken", circle(2)));
    ASSERT_TRUE(exportTo(out, circle(2)));
    EXPECT_TRUE(tree(out) == tree(folder_ / "unbroken"));
}

TEST_F(DatasetResumeGl, WritesTheChosenModalitiesAndFormatsOnly) {
    const Trajectory trajectory = circle(3);
    DatasetSettings settings = settingsFor(folder_ / "all", false);
    const auto all = exportWith(settings, trajectory);
    ASSERT_TRUE(all);
    settings.folder = folder_ / "some";
    settings.modalities = {"semantic", "depth"};
    settings.formats = {"camera_json"};
    const auto some = exportWith(settings, trajectory);
    ASSERT_TRUE(some) << describe(some.error());
    EXPECT_EQ(some->counted.well_captured, all->counted.well_captured);

    const auto expected = tree(folder_ / "all");
    auto files = tree(folder_ / "some");
    EXPECT_EQ(files.size(), 3U * 2 + 3);
    const auto card = nlohmann::json::parse(files.at("dataset.json"));
    EXPECT_EQ(card.at("modalities"), (std::vector<std::string>{"depth", "semantic"}));
    EXPECT_EQ(card.at("formats"), std::vector<std::string>{"camera_json"});
    EXPECT_FALSE(card.at("conventions").contains("rgb"));
    EXPECT_FALSE(card.at("conventions").contains("coco"));
    EXPECT_EQ(card.at("files").size(), files.size() - 1);
    for (const char* same : {"depth/000002.png", "semantic/000001.png", "camera.json"}) {
        EXPECT_EQ(files.at(same), expected.at(same)) << same;
    }
    // The contact sheet shows the frames that exist.
    const cv::Mat sheet = cv::imread((folder_ / "some/contact_sheet.jpg").string());
    ASSERT_FALSE(sheet.empty());
    EXPECT_GT(cv::mean(sheet)[0], 40.0);
    EXPECT_NE(files.at("contact_sheet.jpg"), expected.at("contact_sheet.jpg"));

    settings.modalities = {"rbg"};
    const auto unknown = exportWith(settings, trajectory);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::Usage);
    EXPECT_NE(unknown.error().message.find("'rgb'"), std::string::npos);
}

// A preview renders the same image that an export writes.
TEST_F(DatasetResumeGl, TheFilesHoldWhatTheSceneRendererDraws) {
    const Trajectory trajectory = circle(4);
    ASSERT_TRUE(exportTo(folder_ / "out", trajectory));
    auto context = gl::createOsMesaContext();
    ASSERT_TRUE(context);
    const LightVolume light = bakeLightVolume(scene_, rays_, makeLightRig(scene_, rays_, {}));
    auto renderer = OffscreenRenderer::create(std::move(*context), scene_, light,
                                              smallCamera().width_px, smallCamera().height_px);
    ASSERT_TRUE(renderer);
    const DatasetContents contents{scene_, smallCamera(), {}, {}};
    const MovingObjects moving(scene_, rays_, {});
    const FrameContext context_of_frames{contents, moving};
    for (const int i : {2, 0}) {  // in another order than the export's
        View view = makeView(smallCamera(), trajectory.frames[i].pose);
        view.antialias = PictureParams{}.antialias;
        const auto frame = renderer->render(view);
        ASSERT_TRUE(frame);
        FrameRecord numbered = *frame;
        numbered.index = i;
        for (const Modality& modality : modalities()) {
            if (!modality.standard) continue;
            const auto files = modality.encode(context_of_frames, numbered);
            ASSERT_TRUE(files);
            ASSERT_EQ(files->size(), 1U);
            const auto& [path, bytes] = files->front();
            EXPECT_EQ(path, frameFile(modality.name, i));
            EXPECT_EQ(std::string(bytes.begin(), bytes.end()), read(folder_ / "out" / path));
        }
    }
}

}  // namespace
}  // namespace dollytrack::render::dataset_resume_gl_test
