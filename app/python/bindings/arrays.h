#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::python {

/// Decodes UTF-8 to a Python str; invalid bytes become U+FFFD.
inline pybind11::object textOf(const std::string& bytes) {
    return pybind11::bytes(bytes).attr("decode")("utf-8", "replace");
}

using Shape = std::vector<pybind11::ssize_t>;

/// A read-only array that refers to the owner's memory without copying and keeps the owner alive.
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

/// An array that takes ownership of the values.
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
