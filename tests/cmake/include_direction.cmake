cmake_minimum_required(VERSION 3.25)

# Fails when a source file includes against the direction of the folders, which the linker cannot
# see while the leak is in headers only, or opens files past the function that guards it. Usage: cmake -DROOT=... -P include_direction.cmake
set(engine_MAY engine)
set(planning_MAY engine planning)
set(render_MAY engine render)
set(ui_MAY engine planning render ui)
set(app_MAY engine planning render ui app)
set(wrong 0)
foreach(folder engine planning render ui app)
    file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp)
    foreach(file ${files})
        file(STRINGS ${file} lines REGEX "^#include \"")
        foreach(line ${lines})
            string(REGEX REPLACE "^#include \"([^/\"]*)/?.*" "\\1" target "${line}")
            if(NOT target IN_LIST ${folder}_MAY)
                message("${file}: ${folder} may not know ${line}")
                math(EXPR wrong "${wrong} + 1")
            endif()
        endforeach()
    endforeach()
endforeach()
# Libraries stay inside the folders that own them: "beginning of the header|folders without it".
# ui has the numbers of the keys from GLFW: Dear ImGui 1.86 hands them through.
foreach(rule "imgui|engine,planning,render" "GLFW/|engine,planning,render"
             "GL/|engine,planning,ui,app" "assimp/|planning,render,ui,app"
             "octomap/|engine,render,ui,app" "embree|planning,render,ui,app"
             "hdf5|planning,render,ui,app")
    string(REPLACE "|" ";" parts "${rule}")
    list(GET parts 0 header)
    list(GET parts 1 folders)
    string(REPLACE "," ";" folders "${folders}")
    foreach(folder ${folders})
        file(GLOB_RECURSE files ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp)
        foreach(file ${files})
            file(STRINGS ${file} lines REGEX "^#include <${header}")
            foreach(line ${lines})
                message("${file}: ${line} does not belong into ${folder}")
                math(EXPR wrong "${wrong} + 1")
            endforeach()
        endforeach()
    endforeach()
endforeach()
# Files of any origin are opened by engine/io/sandbox/input_file.h, which waits for no pipe, and JSON
# is measured before it is parsed: "call|the only files that may contain it". What is below /proc is
# the system's own.
foreach(rule "[jJ]son::parse\\(|engine/io/files/bounded_json.cpp"
             "json::accept\\(|"
             "toml::parse\\(|app/batch/jobs_file.cpp"
             "ifstream|app/editor/export/owner_mark.cpp,engine/io/sandbox/processor_wait.cpp"
             "fopen\\(|"
             "cv::imread\\(|")
    string(REPLACE "|" ";" parts "${rule}")
    list(GET parts 0 call)
    list(GET parts 1 may)
    string(REPLACE "," ";" may "${may}")
    foreach(folder engine planning render ui app)
        file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp)
        list(REMOVE_ITEM files ${may})
        foreach(file ${files})
            file(STRINGS ${ROOT}/${file} lines REGEX "^[^/]*${call}")
            foreach(line ${lines})
                message("${file}: ${line}: files are opened by engine/io/sandbox/input_file.h, and "
                        "JSON is parsed by engine/io/files/bounded_json.h")
                math(EXPR wrong "${wrong} + 1")
            endforeach()
        endforeach()
    endforeach()
endforeach()
if(wrong)
    message(FATAL_ERROR "${wrong} includes or calls are where they must not be")
endif()
