#include "engine/scene/label_table.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    dollytrack::LabelTable table;
    (void)table.add(text, "labels.csv");
    (void)table.find(text.substr(0, 200));
    return 0;
}
