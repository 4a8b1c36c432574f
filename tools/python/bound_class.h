#pragma once

// Classes of the module that refuse objects whose __init__() did not run.
//
// Python can make such objects, by X.__new__(X) or in a subclass that uses itself before super().__init__(). For those
// pybind11 would hand over memory in which nothing was made.

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <typeinfo>

namespace rimline::python {

/// A class of `module`. To use an object of it that was not made is a TypeError. Cast to Class& before to its holder:
/// the cast to a holder throws RuntimeError.
template <typename Class, typename... Options>
pybind11::class_<Class, Options...> bound_class(const pybind11::module_& module, const char* name,
                                                const char* what) {
    pybind11::class_<Class, Options...> bound(module, name, what);
    // pybind11 calls it only for memory of an object that was not made.
    pybind11::detail::get_type_info(typeid(Class), true)->operator_new = [](std::size_t) -> void* {
        throw pybind11::type_error(
            pybind11::type::of<Class>().attr("__name__").template cast<std::string>() +
            ".__init__() was not called");
    };
    return bound;
}

}  // namespace rimline::python
