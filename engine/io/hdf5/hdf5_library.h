#pragma once

#include <hdf5.h>

#include <mutex>

namespace dollytrack {

/// Held while the library is in use: it may be built without locks of its own, as Debian's is.
class Hdf5Lock {
  public:
    Hdf5Lock() : lock_(mutex()) {}

  private:
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> lock_;
};

/// An HDF5 handle and what closes it.
class Hdf5Handle {
  public:
    Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;
    operator hid_t() const { return id_; }  // NOLINT: stands for the number in HDF5's calls

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

}  // namespace dollytrack
