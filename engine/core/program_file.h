#pragma once

#include <filesystem>
#include <string>

namespace dollytrack {

/// The file that holds this code: the running program, or the shared library it was loaded as (a
/// Python module). Empty where the system does not say.
[[nodiscard]] std::filesystem::path ownFile();

/// A path by which ownFile() can be opened even if a running program's file was replaced meanwhile.
[[nodiscard]] std::filesystem::path ownContent();

/// One of our programs: beside ownFile(), else where programs are installed. The first of the two
/// where it is in neither, for the message.
[[nodiscard]] std::filesystem::path siblingProgram(const std::string& name);

}  // namespace dollytrack
