#pragma once

#include "engine/jobs/job.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace dollytrack::planning::test_support {

/// Progress that must rise from 0 to 1 without ever falling.
class RisingProgress {
  public:
    [[nodiscard]] JobContext job() {
        return {{}, [this](double fraction, std::string_view stage) {
                    EXPECT_GE(fraction, last_) << stage << " after " << last_stage_;
                    EXPECT_LE(fraction, 1.0 + 1e-9) << stage;
                    last_ = fraction;
                    last_stage_ = stage;
                    ++reports_;
                }};
    }

    [[nodiscard]] double last() const { return last_; }
    [[nodiscard]] int reports() const { return reports_; }

  private:
    double last_ = 0.0;
    std::string last_stage_;
    int reports_ = 0;
};

}  // namespace dollytrack::planning::test_support
