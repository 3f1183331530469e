#include "engine/io/sandbox/confined_program.h"
#include "engine/io/sandbox/importer.h"

#include <cstdio>
#include <string_view>

int main(int argc, char** argv) {
    if (argc > 1 && std::string_view(argv[1]) == dollytrack::kConfine) {
        return dollytrack::runConfined(argc, argv);
    }
    const int code = dollytrack::runImporter(argc, argv);
    if (code == 2) {
        std::fputs(
            "dollytrack-import: dollytrack and dollytrack-editor start this program to read a "
            "scene file in a separate process; it does nothing by itself.\n",
            stderr);
    }
    return code;
}
