#pragma once

#include "engine/core/result.h"

#include <memory>
#include <optional>
#include <utility>

namespace dollytrack::planning {

/// Caches the last output of a function and recomputes it only when its inputs change. `version`
/// grows with every new output; later stages take it as an input.
template <class Inputs, class Output>
class Stage {
  public:
    /// Calls make() -> Result<Output> unless the inputs equal those of the last success. After a
    /// failure the stage is empty.
    template <class Make>
    Status update(const Inputs& inputs, Make&& make) {
        reused_ = inputs_ && *inputs_ == inputs;
        if (reused_) return {};
        inputs_.reset();
        output_.reset();
        Result<Output> made = make();
        if (!made) return tl::unexpected(std::move(made.error()));
        output_ = std::make_shared<const Output>(std::move(*made));
        inputs_ = inputs;
        ++version_;
        return {};
    }

    /// Whether update() with these inputs would keep the output.
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
