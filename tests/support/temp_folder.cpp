#include "tests/support/temp_folder.h"

#include <stdlib.h>
#include <fstream>
#include <stdexcept>

namespace dollytrack::test {

TempFolder::TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "dollytrack-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TempFolder::write(const std::string& name, std::string_view text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

}  // namespace dollytrack::test
