#pragma once

#include <CLI/CLI.hpp>

namespace dollytrack::cli {

/// A help formatter that marks only options with several values at once by "...", not options that
/// are repeated for each value.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace dollytrack::cli
