#include "render/frames/frame_file.h"

#include <fmt/format.h>

namespace dollytrack::render {

std::string frameFile(const std::string& folder, int index, const std::string& ending) {
    return fmt::format("{}/{:06}{}", folder, index, ending);
}

std::string pairFile(const std::string& folder, int from, int to, const std::string& ending) {
    return fmt::format("{}/{:06}_{:06}{}", folder, from, to, ending);
}

}  // namespace dollytrack::render
