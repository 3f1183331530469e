#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::python {

/// A str of UTF-8 text; invalid bytes become U+FFFD.
inline pybind11::object textOf(const std::string& bytes) {
    return pybind11::bytes(bytes).attr("decode")("utf-8", "replace");
}

using Shape = std::vector<pybind11::ssize_t>;

/// An array that shows memory of the owner's without copying it. It cannot be written to, and keeps
/// the owner for as long as it lives.
template <class T>
pybind11::array viewOf(const T* values, Shape shape, std::shared_ptr<const void> owner) {
    auto kept = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
    const pybind11::capsule base(
        kept.get(), [](void* held) { delete static_cast<std::shared_ptr<const void>*>(held); });
    (void)kept.release();
    pybind11::array_t<T> view(std::move(shape), values, base);
    view.attr("flags").attr("writeable") = false;
    return view;
}

/// An array that owns the values.
template <class T>
pybind11::array arrayOf(std::vector<T> values, Shape shape) {
    auto kept = std::make_unique<std::vector<T>>(std::move(values));
    const T* first = kept->data();
    const pybind11::capsule base(kept.get(),
                                 [](void* held) { delete static_cast<std::vector<T>*>(held); });
    (void)kept.release();
    return pybind11::array_t<T>(std::move(shape), first, base);
}

}  // namespace dollytrack::python
