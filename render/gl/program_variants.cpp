#include "render/gl/program_variants.h"

#include "render/gl/shader.h"

namespace dollytrack::gl {

Status ProgramVariants::link(unsigned bits) {
    if (programs_.contains(bits)) return {};
    std::vector<std::string> defined;
    for (std::size_t i = 0; i < words_.size(); ++i) {
        if ((bits >> i & 1U) != 0) defined.push_back(words_[i]);
    }
    Result<Program> linked = linkProgram(vertex_, fragment_, defined);
    if (!linked) return tl::unexpected(linked.error());
    programs_.emplace(bits, std::move(*linked));
    return {};
}

}  // namespace dollytrack::gl
