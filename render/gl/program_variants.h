#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <map>
#include <string>
#include <vector>

namespace dollytrack::gl {

/// Programs of the same two shaders, told apart by words to the fragment's preprocessor: on the
/// processor both sides of a branch take their time, so that what is not wanted must not be there.
class ProgramVariants {
  public:
    ProgramVariants(std::string vertex, std::string fragment, std::vector<std::string> words)
        : vertex_(std::move(vertex)), fragment_(std::move(fragment)), words_(std::move(words)) {}

    /// Links the one that is meant by the words whose bits are set, where it has not been yet.
    /// Failed with the compiler's words.
    [[nodiscard]] Status link(unsigned bits);

    /// One that is linked.
    [[nodiscard]] unsigned get(unsigned bits) const { return programs_.at(bits).get(); }

  private:
    std::string vertex_;
    std::string fragment_;
    std::vector<std::string> words_;  // of bit 0, 1, ...
    std::map<unsigned, Program> programs_;
};

}  // namespace dollytrack::gl
