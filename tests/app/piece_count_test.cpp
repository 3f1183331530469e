#include "app/editor/piece_count.h"

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

namespace dollytrack::editor {
namespace {

/// Lets a test wait for the background.
class Bell {
  public:
    void ring() {
        const std::lock_guard lock(mutex_);
        rung_ = true;
        heard_.notify_all();
    }
    void wait() {
        std::unique_lock lock(mutex_);
        heard_.wait(lock, [&] { return rung_; });
        rung_ = false;
    }

  private:
    std::mutex mutex_;
    std::condition_variable heard_;
    bool rung_ = false;
};

TEST(PieceCount, CountsTheConnectedPiecesOfTheObjectThatIsAskedFor) {
    test::SceneBuilder builder;
    builder.object("one").box({0, 0, 0}, {1, 1, 1});
    builder.object("three")
        .box({3, 0, 0}, {1, 1, 1})
        .box({6, 0, 0}, {1, 1, 1})
        .box({9, 0, 0}, {1, 1, 1});
    const auto scene = std::make_shared<const Scene>(builder.build());
    Bell bell;
    PieceCount count([&bell] { bell.ring(); });
    const auto counted = [&](int object) {
        std::optional<std::size_t> pieces = count.of(scene, object);
        EXPECT_FALSE(pieces.has_value()) << "known before it was counted";
        while (!pieces) {
            bell.wait();
            pieces = count.of(scene, object);
        }
        return *pieces;
    };
    EXPECT_EQ(counted(1), 1U);
    EXPECT_EQ(counted(2), 3U);
    EXPECT_EQ(count.of(nullptr, 1), std::nullopt);
    EXPECT_EQ(count.of(scene, 3), std::nullopt);
}

}  // namespace
}  // namespace dollytrack::editor
