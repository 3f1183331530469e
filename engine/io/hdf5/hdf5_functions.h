#pragma once

#include <hdf5.h>

namespace dollytrack {

// Each name once: its type is the header's, its symbol the library's.
// clang-format off
#define DOLLYTRACK_HDF5_FUNCTIONS(each)                                                           \
    each(H5open) each(H5Eset_auto2) each(H5PLset_loading_state)                                   \
    each(H5Pcreate) each(H5Pclose) each(H5Pset_fapl_core) each(H5Pset_file_image)                 \
    each(H5Pget_external_count) each(H5Pget_layout) each(H5Pset_chunk) each(H5Pset_deflate)       \
    each(H5Pset_obj_track_times) each(H5Pset_shuffle)                                             \
    each(H5Fopen) each(H5Fclose) each(H5Fcreate) each(H5Fflush) each(H5Fget_file_image)           \
    each(H5Lget_info)                                                                             \
    each(H5Dopen2) each(H5Dclose) each(H5Dget_create_plist) each(H5Dget_space) each(H5Dget_type)  \
    each(H5Dread) each(H5Dcreate2) each(H5Dwrite)                                                 \
    each(H5Sclose) each(H5Sget_simple_extent_ndims) each(H5Sget_simple_extent_dims)               \
    each(H5Sget_simple_extent_npoints) each(H5Screate) each(H5Screate_simple)                     \
    each(H5Tclose) each(H5Tget_class) each(H5Tget_size) each(H5Tis_variable_str) each(H5Tcopy)    \
    each(H5Tset_size) each(H5Tset_strpad)
// The library's ids of types and property lists: the name here and the library's.
#define DOLLYTRACK_HDF5_IDS(each)                                                                 \
    each(native_double, H5T_NATIVE_DOUBLE_g) each(native_float, H5T_NATIVE_FLOAT_g)               \
    each(native_uint8, H5T_NATIVE_UINT8_g) each(native_uint16, H5T_NATIVE_UINT16_g)               \
    each(c_string, H5T_C_S1_g)                                                                    \
    each(file_access, H5P_CLS_FILE_ACCESS_ID_g) each(dataset_create, H5P_CLS_DATASET_CREATE_ID_g)
// clang-format on

/// The functions of HDF5 that reading and writing need. The library depends on thirty others for
/// networks and cryptography, so it is loaded at the first use.
struct Hdf5Functions {
#define DOLLYTRACK_DECLARE(name) decltype(&::name) name = nullptr;
    DOLLYTRACK_HDF5_FUNCTIONS(DOLLYTRACK_DECLARE)
#undef DOLLYTRACK_DECLARE
#define DOLLYTRACK_DECLARE(name, symbol) hid_t name = -1;
    DOLLYTRACK_HDF5_IDS(DOLLYTRACK_DECLARE)
#undef DOLLYTRACK_DECLARE
};

/// Loads the library once; null if it is missing. Safe to call from many threads. A process that
/// will no longer be allowed to open files must call it before.
const Hdf5Functions* hdf5Functions();

}  // namespace dollytrack
