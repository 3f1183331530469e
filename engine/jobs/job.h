#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace dollytrack {

/// Handed to every long function: it reports progress through it and asks it whether to stop.
/// A default one never cancels and reports nowhere. Cheap to copy; copies share one cancel flag.
class JobContext {
  public:
    using Progress = std::function<void(double fraction, std::string_view stage)>;

    /// Progress of work with countable items. Called before `progress`, for the same step.
    using Items = std::function<void(int done, int total)>;

    JobContext() = default;
    JobContext(std::shared_ptr<const std::atomic<bool>> cancel_flag, Progress progress,
               Items items = {})
        : cancel_flag_(std::move(cancel_flag)),
          progress_(std::move(progress)),
          items_(std::move(items)) {}

    [[nodiscard]] bool cancelled() const {
        return cancel_flag_ && cancel_flag_->load(std::memory_order_relaxed);
    }

    /// Reports `fraction` (0..1) of this context's share. Call from one thread only.
    void report(double fraction) const {
        if (progress_) progress_(begin_ + (end_ - begin_) * fraction, stage_);
    }

    /// The same for `done` of `total` pieces of equal size.
    void reportItems(int done, int total) const {
        if (items_) items_(done, total);
        report(total > 0 ? static_cast<double>(done) / total : 1.0);
    }

    /// A context whose 0..1 is `begin`..`end` of this one, under a stage name.
    [[nodiscard]] JobContext stage(double begin, double end, std::string_view name) const {
        JobContext part = *this;
        part.begin_ = begin_ + (end_ - begin_) * begin;
        part.end_ = begin_ + (end_ - begin_) * end;
        part.stage_ = name;
        return part;
    }

  private:
    std::shared_ptr<const std::atomic<bool>> cancel_flag_;
    Progress progress_;
    Items items_;
    double begin_ = 0.0;
    double end_ = 1.0;
    std::string stage_;
};

}  // namespace dollytrack
