#include "render/pipeline/frame_writer.h"

#include "render/scene/moving_objects.h"
#include "tests/support/scene_builder.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <thread>

namespace dollytrack::render::frame_writer_test {
namespace {

std::atomic<int> handed_over = 0;
int waits_for = 0;

/// Waits until `waits_for` frames were handed over, and 5 ms more; writes nothing.
Result<std::vector<FrameFile>> slowly(const FrameContext& /*context*/,
                                      const FrameRecord& /*frame*/) {
    while (handed_over < waits_for) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return std::vector<FrameFile>{};
}

const Modality kSlow = {"slow", "", ContentGroup::Colour, 0.0, false, 0, slowly, nullptr};

class FrameWriterTest : public testing::Test {
  protected:
    /// The largest number of unfinished frames right after handing one over.
    int mostOnTheirWay(std::size_t max_bytes, std::size_t frame_bytes, int frames) {
        std::atomic<int> done = 0;
        handed_over = 0;
        FrameWriter::Settings settings{
            *GuardedFolder::open(folder_.path()), {&kSlow}, {}, 0, max_bytes};
        FrameWriter writer(settings, context_, [&](WrittenFrame) -> Status {
            ++done;
            return {};
        });
        int most = 0;
        for (int i = 0; i < frames; ++i) {
            FrameRecord frame;
            frame.index = i;
            frame.sensor_light.resize(frame_bytes / sizeof(float));
            EXPECT_TRUE(writer.write(std::move(frame)));
            most = std::max(most, ++handed_over - done);
        }
        EXPECT_TRUE(writer.finish());
        EXPECT_EQ(done, frames);
        return most;
    }

    Scene scene_ = dollytrack::test::furnishedRoom();
    RayCaster rays_{scene_};
    DatasetContents contents_{scene_, {}, {}, {}};
    MovingObjects moving_{scene_, rays_, {}};
    FrameContext context_{contents_, moving_};
    dollytrack::test::TempFolder folder_;
};

TEST_F(FrameWriterTest, HoldsNoMoreBytesThanItMay) {
    waits_for = 4;
    EXPECT_GE(mostOnTheirWay(1 << 20, 1000, 12), 4) << "small ones queue";
    waits_for = 0;
    EXPECT_LE(mostOnTheirWay(250'000, 100'000, 12), 2);
    EXPECT_EQ(mostOnTheirWay(250'000, 200'000, 6), 1);
    EXPECT_EQ(mostOnTheirWay(250'000, 400'000, 6), 1) << "larger than all that it may hold";
}

TEST_F(FrameWriterTest, CountsAllImagesOfAFrame) {
    FrameRecord frame;
    EXPECT_EQ(frame.bytes(), 0U);
    frame.rgb.resize(30);
    frame.depth_m.resize(10);
    frame.instance.resize(10);
    frame.semantic.resize(10);
    frame.normals_in_world.resize(10);
    frame.albedo.resize(30);
    frame.rgb_right.resize(30);
    frame.depth_right_m.resize(10);
    frame.sensor_light.resize(30);
    frame.whole.resize(2);
    frame.whole[1].inside.resize(7);
    frame.rig_rgb.assign(3, std::vector<std::uint8_t>(6));
    const std::size_t pictures = 3 * 2 * (3 + 3) + 24 * 2;  // and the encoded files
    EXPECT_EQ(frame.bytes(), 30U + 40 + 20 + 20 + 120 + 30 + 30 + 40 + 120 + 7 + pictures);
}

}  // namespace
}  // namespace dollytrack::render::frame_writer_test
