#include "engine/io/sandbox/importer.h"

#include <cstdio>

int main(int argc, char** argv) {
    const int code = dollytrack::runImporter(argc, argv);
    if (code == 2) {
        std::fputs(
            "dollytrack-import: dollytrack and dollytrack-editor start this program to read a "
            "scene file in a separate process; it does nothing by itself.\n",
            stderr);
    }
    return code;
}
