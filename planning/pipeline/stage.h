#pragma once

#include "engine/core/result.h"

#include <memory>
#include <optional>
#include <utility>

namespace dollytrack::planning {

/// Remembers the last output of a function of its inputs and makes it anew only when they change.
/// `version` grows with every new output: a later stage takes it as one of its inputs.
template <class Inputs, class Output>
class Stage {
  public:
    /// Calls make() -> Result<Output> unless the inputs equal those of the last success. After a
    /// failure nothing is remembered.
    template <class Make>
    Status update(const Inputs& inputs, Make&& make) {
        reused_ = inputs_ && *inputs_ == inputs;
        if (reused_) return {};
        inputs_.reset();
        output_.reset();
        Result<Output> made = make();
        if (!made) return tl::unexpected<Error>(std::move(made.error()));
        output_ = std::make_shared<const Output>(std::move(*made));
        inputs_ = inputs;
        ++version_;
        return {};
    }

    /// Whether update() would keep what there is.
    [[nodiscard]] bool holds(const Inputs& inputs) const { return inputs_ && *inputs_ == inputs; }

    [[nodiscard]] const Output& operator*() const { return *output_; }
    [[nodiscard]] const Output* operator->() const { return output_.get(); }
    [[nodiscard]] std::shared_ptr<const Output> share() const { return output_; }
    [[nodiscard]] unsigned version() const { return version_; }
    [[nodiscard]] bool reused() const { return reused_; }

  private:
    std::optional<Inputs> inputs_;
    std::shared_ptr<const Output> output_;
    unsigned version_ = 0;
    bool reused_ = false;
};

}  // namespace dollytrack::planning
