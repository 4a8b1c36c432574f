#include "tools/python/errors.h"

#include <CLI/App.hpp>
#include <array>
#include <cerrno>
#include <string>

#include "silhouette/error.h"
#include "tools/command.h"
#include "tools/python/keywords.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

// By ErrorCode. Owned by the module, which is never unloaded.
std::array<PyObject*, 6> g_exceptions{};

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

// As Python's own functions have names of files.
py::object file_name(const std::string& path) {
    PyObject* const name =
        PyUnicode_DecodeFSDefaultAndSize(path.data(), static_cast<Py_ssize_t>(path.size()));
    if (name == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(name);
}

// With `errno` and `filename`, and as FileNotFoundError too where that is meant.
void raise_file_error(const FileError& failure) {
    PyObject* const exception =
        failure.number() == ENOENT ? g_missing_file : g_exceptions[std::size_t(ErrorCode::io)];
    const auto make = py::reinterpret_borrow<py::object>(exception);
    const py::str text = message_text(failure.what());
    const py::object name = file_name(failure.path());
    py::object error;
    if (failure.number() != 0) {
        error = make(failure.number(), text, name);
    } else {  // OSError has no filename without errno.
        error = make(text);
        error.attr("filename") = name;
    }
    PyErr_SetObject(exception, error.ptr());
}

// The library's message alone, which begins with the file's name: OSError's own text has errno before it and the name
// after it.
py::object text_of_file_error(const py::object& error) {
    const py::object text = error.attr("strerror"), name = error.attr("filename");
    if (text.is_none()) return py::handle(PyExc_Exception).attr("__str__")(error);
    if (py::isinstance<py::str>(text) && py::isinstance<py::str>(name)) {
        const auto bytes = py::reinterpret_steal<py::bytes>(PyUnicode_EncodeFSDefault(name.ptr()));
        if (!bytes) throw py::error_already_set();
        const py::str start = message_text(bytes.cast<std::string>() + ": ");
        if (text.attr("startswith")(start).cast<bool>()) return text;
    }
    return py::handle(PyExc_OSError).attr("__str__")(error);
}

}  // namespace

py::str message_text(std::string_view message) {
    PyObject* const text = PyUnicode_DecodeUTF8(
        message.data(), static_cast<Py_ssize_t>(message.size()), "backslashreplace");
    if (text == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(text);
}

void warn(const std::string& warning) {
    if (PyErr_WarnFormat(PyExc_UserWarning, 1, "%U", message_text(warning).ptr()) != 0)
        throw py::error_already_set();
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
        "The system could not read or write. The message names the path, and so does filename; "
        "errno is the system's, if it has one.");
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
        } catch (const FileError& error) {
            raise_file_error(error);
        } catch (const Error& error) {
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
