#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <map>
#include <string>
#include <vector>

namespace dollytrack::gl {

/// Variants of one shader program that differ in the macros defined for the fragment shader. A
/// branch would cost time on both sides when the CPU renders, so unwanted code is compiled out.
class ProgramVariants {
  public:
    ProgramVariants(std::string vertex, std::string fragment, std::vector<std::string> words)
        : vertex_(std::move(vertex)), fragment_(std::move(fragment)), words_(std::move(words)) {}

    /// Links the variant whose macros are the set bits of `bits`, unless it is linked already.
    /// Returns Failed with the compiler's message if that fails.
    [[nodiscard]] Status link(unsigned bits);

    /// The OpenGL name of a variant that link() has linked.
    [[nodiscard]] unsigned get(unsigned bits) const { return programs_.at(bits).get(); }

  private:
    std::string vertex_;
    std::string fragment_;
    std::vector<std::string> words_;  // macro names of bit 0, 1, ...
    std::map<unsigned, Program> programs_;
};

}  // namespace dollytrack::gl
