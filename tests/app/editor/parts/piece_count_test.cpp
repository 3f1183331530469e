#include "app/editor/objects/piece_count.h"

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

namespace dollytrack::editor::piece_count_test {
namespace {

/// Lets a test wait for the background thread.
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

TEST(PieceCount, MeasuresTheConnectedPiecesOfTheObjectThatIsAskedFor) {
    test::SceneBuilder builder;
    builder.object("one").box({0, 0, 0}, {1, 1, 1});
    builder.object("three")
        .box({3, 0, 0}, {1, 1, 1})
        .box({6, 0, 0}, {1, 1, 0.5})
        .box({9, 0, 0}, {0.25, 0.1, 0.1});
    const auto scene = std::make_shared<const Scene>(builder.build());
    Bell bell;
    PieceCount count([&bell] { bell.ring(); });
    const auto measured = [&](int object) {
        const std::vector<double>* sizes = count.of(scene, object);
        EXPECT_EQ(sizes, nullptr) << "known before they were measured";
        while (sizes == nullptr) {
            bell.wait();
            sizes = count.of(scene, object);
        }
        return *sizes;
    };
    EXPECT_EQ(measured(1), std::vector<double>{1.0});
    EXPECT_EQ(measured(2), (std::vector<double>{1.0, 1.0, 0.25}));
    EXPECT_EQ(count.of(nullptr, 1), nullptr);
    EXPECT_EQ(count.of(scene, 3), nullptr);
}

}  // namespace
}  // namespace dollytrack::editor::piece_count_test
