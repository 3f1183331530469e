#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <utility>

namespace dollytrack::gather {

/// Reads numbered inputs in order, the next one on a thread of its own while the caller works with
/// the current one. Memory holds one input besides the caller's.
template <class Input>
class ReadAhead {
  public:
    /// Calls `read` with 0 to `count` - 1.
    ReadAhead(std::size_t count, std::function<Input(std::size_t)> read)
        : count_(count), read_(std::move(read)) {
        begin();
    }
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;

    /// The next input; at most `count` times. Throws what `read` threw.
    [[nodiscard]] Input next() {
        Input input = next_.get();
        begin();
        return input;
    }

  private:
    void begin() {
        if (begun_ == count_) return;
        // Without a free thread, the input is read by next().
        next_ = std::async(std::launch::async | std::launch::deferred,
                           [this, i = begun_] { return read_(i); });
        ++begun_;
    }

    std::size_t count_;
    std::size_t begun_ = 0;
    std::function<Input(std::size_t)> read_;
    std::future<Input> next_;  // destroyed first: waits for the thread
};

}  // namespace dollytrack::gather
