#include "app/cli/terminal/help_formatter.h"

#include <string_view>

namespace dollytrack::cli {

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    constexpr std::string_view kMore = " ...";
    std::string text = CLI::Formatter::make_option_opts(option);
    // Positional arguments keep the mark.
    const bool named = option->nonpositional();
    const std::size_t at = text.find(kMore);
    if (named && !option->get_allow_extra_args() && at != std::string::npos) {
        text.erase(at, kMore.size());
    }
    return text;
}

}  // namespace dollytrack::cli
