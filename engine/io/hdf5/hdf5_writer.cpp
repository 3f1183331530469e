#include "engine/io/hdf5/hdf5_writer.h"

#include "engine/io/hdf5/hdf5_functions.h"
#include "engine/io/hdf5/hdf5_library.h"
#include "engine/io/hdf5/hdf5_reader.h"

#include <algorithm>

namespace dollytrack {
namespace {

using Handle = Hdf5Handle;

constexpr unsigned kTruncate = 2;  // H5F_ACC_TRUNC; the macro itself calls the library

hid_t nativeType(const Hdf5Functions& h5, Hdf5Type type) {
    switch (type) {
        case Hdf5Type::Uint8:
            return h5.native_uint8;
        case Hdf5Type::Uint16:
            return h5.native_uint16;
        case Hdf5Type::Float32:
            break;
    }
    return h5.native_float;
}

bool add(const Hdf5Functions& h5, hid_t file, const Hdf5Array& array) {
    const std::vector<hsize_t> shape(array.shape.begin(), array.shape.end());
    const int rank = static_cast<int>(shape.size());
    std::vector<hsize_t> chunk = shape;
    chunk.front() = std::min<hsize_t>(chunk.front(), 64);
    const Handle space(h5.H5Screate_simple(rank, shape.data(), nullptr), h5.H5Sclose);
    const Handle how(h5.H5Pcreate(h5.dataset_create), h5.H5Pclose);
    bool good = h5.H5Pset_chunk(how, rank, chunk.data()) >= 0 && h5.H5Pset_shuffle(how) >= 0 &&
                h5.H5Pset_deflate(how, 1) >= 0;
    // Without this, the file contains its creation time and differs between runs.
    good = good && h5.H5Pset_obj_track_times(how, 0) >= 0;
    const hid_t type = nativeType(h5, array.type);
    const Handle data(
        h5.H5Dcreate2(file, array.name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT),
        h5.H5Dclose);
    return good && data >= 0 &&
           h5.H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values) >= 0;
}

bool add(const Hdf5Functions& h5, hid_t file, const Hdf5Text& text) {
    const Handle type(h5.H5Tcopy(h5.c_string), h5.H5Tclose);
    const Handle space(h5.H5Screate(H5S_SCALAR), h5.H5Sclose);
    const Handle how(h5.H5Pcreate(h5.dataset_create), h5.H5Pclose);
    const bool good = h5.H5Tset_size(type, text.text.size()) >= 0 &&
                      h5.H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 &&
                      h5.H5Pset_obj_track_times(how, 0) >= 0;
    const Handle data(
        h5.H5Dcreate2(file, text.name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT),
        h5.H5Dclose);
    return good && data >= 0 &&
           h5.H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.text.data()) >= 0;
}

}  // namespace

Result<std::vector<std::uint8_t>> packHdf5(const std::vector<Hdf5Array>& arrays,
                                           const std::vector<Hdf5Text>& texts) {
    const Hdf5Functions* library = hdf5Functions();
    if (library == nullptr) {
        return fail(ErrorCode::Failed, missingHdf5());
    }
    const Hdf5Functions& h5 = *library;
    const Hdf5Lock lock;
    constexpr std::size_t kGrowth = 1U << 20U;
    const Handle access(h5.H5Pcreate(h5.file_access), h5.H5Pclose);
    std::vector<std::uint8_t> bytes;
    bool good = h5.H5Pset_fapl_core(access, kGrowth, 0) >= 0;  // in memory only
    const Handle file(good ? h5.H5Fcreate("memory.hdf5", kTruncate, H5P_DEFAULT, access) : -1,
                      h5.H5Fclose);
    good = file >= 0;
    for (const Hdf5Array& array : arrays) good = good && add(h5, file, array);
    for (const Hdf5Text& text : texts) good = good && add(h5, file, text);
    good = good && h5.H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
    const ssize_t size = good ? h5.H5Fget_file_image(file, nullptr, 0) : -1;
    if (size > 0) {
        bytes.resize(size);
        good = h5.H5Fget_file_image(file, bytes.data(), bytes.size()) == size;
    }
    if (!good || size <= 0) {
        return fail(ErrorCode::Failed, "HDF5 could not create the file; check the free memory.");
    }
    return bytes;
}

}  // namespace dollytrack
