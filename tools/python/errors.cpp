#include "tools/python/errors.h"

#include <CLI/App.hpp>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "silhouette/error.h"
#include "tools/command.h"
#include "tools/python/keywords.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

// By ErrorCode. Owned by the module, which is never unloaded.
std::array<PyObject*, 6> g_exceptions{};

constexpr int k_system_errors = 134;  // Of Linux.

PyObject* make_exception(py::module_& module, const char* name, const py::tuple& bases,
                         const char* what) {
    PyObject* exception = PyErr_NewExceptionWithDoc((std::string("rimline.") + name).c_str(), what,
                                                    bases.ptr(), nullptr);
    if (exception == nullptr) throw py::error_already_set();
    module.add_object(name, py::handle(exception));
    return exception;
}

void raise(PyObject* exception, std::string_view message) {
    PyErr_SetObject(exception, message_text(message).ptr());
}

PyObject* g_missing_file = nullptr;

// The number of the system's error that the message ends with; 0: none.
int system_error_in(std::string_view message) {
    // Said in the library's own words.
    if (message.ends_with("; create it first")) return ENOENT;
    if (message.ends_with("; name a file in it")) return EISDIR;
    for (int number = 1; number < k_system_errors; ++number)
        if (message.ends_with(": " + std::generic_category().message(number))) return number;
    return 0;
}

// With `errno`, and as FileNotFoundError too where that is meant.
void raise_file_error(std::string_view message) {
    const int number = system_error_in(message);
    PyObject* const exception =
        number == ENOENT ? g_missing_file : g_exceptions[std::size_t(ErrorCode::io)];
    const auto make = py::reinterpret_borrow<py::object>(exception);
    const py::str text = message_text(message);
    // With two arguments OSError keeps errno where it is pickled.
    const py::object error = number == 0 ? make(text) : make(number, text);
    PyErr_SetObject(exception, error.ptr());
}

// The library's message alone: OSError's own text begins with errno.
py::object text_of_file_error(const py::object& error) {
    const py::object text = error.attr("strerror");
    if (py::isinstance<py::str>(text) && error.attr("filename").is_none()) return text;
    return py::handle(PyExc_OSError).attr("__str__")(error);
}

}  // namespace

py::str message_text(std::string_view message) {
    PyObject* const text = PyUnicode_DecodeUTF8(
        message.data(), static_cast<Py_ssize_t>(message.size()), "backslashreplace");
    if (text == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(text);
}

void bind_errors(py::module_& module) {
    const py::handle base_class(make_exception(module, "Error",
                                               py::make_tuple(py::handle(PyExc_Exception)),
                                               "Base class of the errors of Rimline."));
    const auto add = [&](ErrorCode code, const char* name, PyObject* base, const char* what) {
        g_exceptions[static_cast<std::size_t>(code)] =
            make_exception(module, name, py::make_tuple(base_class, py::handle(base)), what);
    };
    add(ErrorCode::bad_input, "InputError", PyExc_ValueError,
        "A file or value is wrong. The message names the file and the place.");
    add(ErrorCode::no_device, "NoDeviceError", PyExc_RuntimeError,
        "No Vulkan device is suitable. The message lists what each device lacks.");
    add(ErrorCode::device_lost, "DeviceLostError", PyExc_RuntimeError, "The GPU stopped.");
    add(ErrorCode::io, "FileError", PyExc_OSError,
        "The system could not read or write. The message names the path; errno is the system's, "
        "if known.");
    const py::object file_error =
        py::reinterpret_borrow<py::object>(g_exceptions[std::size_t(ErrorCode::io)]);
    file_error.attr("__str__") =
        py::cpp_function(&text_of_file_error, py::name("__str__"), py::is_method(file_error));
    g_missing_file =
        make_exception(module, "MissingFileError",
                       py::make_tuple(py::handle(g_exceptions[std::size_t(ErrorCode::io)]),
                                      py::handle(PyExc_FileNotFoundError)),
                       "A file or folder is not there.");
    add(ErrorCode::too_large, "TooLargeError", PyExc_ValueError,
        "A limit of the machine or of a format is exceeded. The message names it.");
    add(ErrorCode::cancelled, "CancelledError", PyExc_RuntimeError,
        "Another thread stopped what the call waits for.");
    py::register_exception_translator([](std::exception_ptr failure) {
        try {
            if (failure) std::rethrow_exception(failure);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::io) return raise_file_error(error.what());
            raise(g_exceptions[static_cast<std::size_t>(error.code())], error.what());
        } catch (const CLI::ValidationError& error) {  // Of the name of a built-in shape.
            const std::string message = error.what();
            raise(PyExc_ValueError, "path" + message.substr(message.find(": ")));
        } catch (const tools::UsageError& error) {
            raise(PyExc_ValueError, in_keywords(error.what()));
        }
    });
}

}  // namespace rimline::python
