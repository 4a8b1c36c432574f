#pragma once

// The library's errors as Python's exceptions.
//
//     rimline.Error                       base class
//       InputError(ValueError)            a file or value is wrong
//       NoDeviceError(RuntimeError)       no Vulkan device is suitable
//       DeviceLostError(RuntimeError)     the GPU stopped
//       FileError(OSError)                the system could not read or write
//       TooLargeError(ValueError)         a limit of the machine or of a format
//       CancelledError(RuntimeError)      another thread stopped what the call waits for
//
// A wrong argument is a TypeError or a ValueError.

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

namespace rimline::python {

/// Text with names of files, which are any bytes: those that are not UTF-8 are escaped, as \xNN.
pybind11::str message_text(std::string_view message);

/// A UserWarning of the caller's line. Throws where warnings are errors.
void warn(const std::string& warning);

void bind_errors(pybind11::module_& module);

}  // namespace rimline::python
