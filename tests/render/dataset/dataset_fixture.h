#pragma once

#include "render/dataset/dataset_job.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace dollytrack::render::fixture {

namespace fs = std::filesystem;

inline CameraParams smallCamera() {
    CameraParams camera;
    camera.width_px = 160;
    camera.height_px = 120;
    return camera;
}

inline Trajectory circle(int frames) {
    Trajectory trajectory;
    for (int i = 0; i < frames; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / frames;
        TrajectoryFrame frame;
        frame.time_s = 0.1 * i;
        frame.target_in_world = {2 + 2 * std::cos(angle), 1.5 + 2 * std::sin(angle), 0.8};
        frame.pose = lookAt({1.9, 1.3, 1.4}, frame.target_in_world);
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

/// Exports a small room into a temporary folder.
class DatasetGlTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        std::string name = (fs::temp_directory_path() / "dollytrack_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    Result<DatasetSummary> exportWith(DatasetSettings settings, const Trajectory& trajectory,
                                      const JobContext& job = {}) {
        if (!context_) {
            Result<std::unique_ptr<gl::Context>> context = gl::createOsMesaContext();
            if (!context) return tl::unexpected(context.error());
            context_ = std::move(*context);
        }
        DatasetOrigin origin;
        origin.product_version = "test";
        origin.parameters_json = parameters_;
        origin.motions = motions_;
        return exportDataset(std::move(context_), scene_, rays_, trajectory, smallCamera(),
                             std::move(settings), origin, job);
    }

    Result<DatasetSummary> exportTo(const fs::path& folder, const Trajectory& trajectory,
                                    bool overwrite = false, const JobContext& job = {}) {
        DatasetSettings settings;
        settings.folder = folder;
        settings.overwrite = overwrite;
        return exportWith(settings, trajectory, job);
    }

    static std::string read(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    static std::map<std::string, std::string> tree(const fs::path& folder) {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.is_regular_file()) {
                files[fs::relative(entry.path(), folder).string()] = read(entry.path());
            }
        }
        return files;
    }

    std::string parameters_ = R"({"camera": {"width_px": 160}})";
    std::vector<ObjectMotion> motions_;
    Scene scene_ = dollytrack::test::furnishedRoom();
    RayCaster rays_{scene_};
    fs::path folder_;
};

}  // namespace dollytrack::render::fixture
