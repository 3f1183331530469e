#pragma once

#include <CLI/CLI.hpp>

namespace dollytrack::cli {

/// Help in which only options that take several values at once are followed by "...": those that
/// are repeated for each value are not.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace dollytrack::cli
