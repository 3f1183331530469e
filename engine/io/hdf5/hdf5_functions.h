#pragma once

#include <hdf5.h>

namespace dollytrack {

// Each name once: its type is the header's, its symbol the library's.
// clang-format off
#define DOLLYTRACK_HDF5_FUNCTIONS(each)                                                           \
    each(H5open) each(H5Eset_auto2) each(H5PLset_loading_state)                                   \
    each(H5Pcreate) each(H5Pclose) each(H5Pset_fapl_core) each(H5Pset_file_image)                 \
    each(H5Pget_external_count) each(H5Pget_layout)                                               \
    each(H5Fopen) each(H5Fclose) each(H5Lget_info)                                                \
    each(H5Dopen2) each(H5Dclose) each(H5Dget_create_plist) each(H5Dget_space) each(H5Dget_type)  \
    each(H5Dread)                                                                                 \
    each(H5Sclose) each(H5Sget_simple_extent_ndims) each(H5Sget_simple_extent_dims)               \
    each(H5Sget_simple_extent_npoints)                                                            \
    each(H5Tclose) each(H5Tget_class) each(H5Tget_size) each(H5Tis_variable_str)
// clang-format on

/// The functions of HDF5 that reading takes. The library brings thirty others, of networks and
/// cryptography, so it is loaded by those who read such a file, when they do.
struct Hdf5Functions {
#define DOLLYTRACK_DECLARE(name) decltype(&::name) name = nullptr;
    DOLLYTRACK_HDF5_FUNCTIONS(DOLLYTRACK_DECLARE)
#undef DOLLYTRACK_DECLARE
    hid_t native_double = -1;  // H5T_NATIVE_DOUBLE
    hid_t file_access = -1;    // H5P_FILE_ACCESS
};

/// Loads the library once; nothing where it is missing. From any thread. A process that may open
/// no files any more has to have called it before.
const Hdf5Functions* hdf5Functions();

}  // namespace dollytrack
