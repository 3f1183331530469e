# Writes version.cpp, only if the commit has changed, to avoid rebuilds.
execute_process(COMMAND git describe --always --exclude "*" --abbrev=10 --dirty=-changed
                WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(commit)
    set(commit " (commit ${commit})")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT [[
#include "app/version.h"

const char* dollytrack::versionText() {
    return "@VERSION@@commit@";
}
]] @ONLY)
