# find_opencv(MODULE...) makes the target opencv::MODULE for each module of OpenCV. OpenCV's own
# CMake package needs all its modules installed, and some of them depend on a hundred packages.
find_path(OPENCV_HEADERS opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
function(find_opencv)
    foreach(module IN LISTS ARGN)
        if(TARGET opencv::${module})
            continue()
        endif()
        find_library(OPENCV_LIBRARY_${module} opencv_${module} REQUIRED)
        add_library(opencv::${module} UNKNOWN IMPORTED GLOBAL)
        set_target_properties(opencv::${module} PROPERTIES
            IMPORTED_LOCATION ${OPENCV_LIBRARY_${module}}
            INTERFACE_INCLUDE_DIRECTORIES ${OPENCV_HEADERS})
    endforeach()
endfunction()
