#pragma once

// Long calls of the library from Python: other Python threads run meanwhile, Ctrl-C stops them, and progress is shown.
//
// The work runs on a thread of its own. The calling thread sleeps without the interpreter's lock and wakes fifty times
// a second, to let Python handle signals and to report progress. So Python's code runs on the calling thread alone.

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>

#include "silhouette/error.h"

namespace rimline::python {

/// Calls work(call) without the interpreter's lock; it must not touch Python's objects. `progress` is None, True (a bar
/// of tqdm), a bar of tqdm, or a function that takes the finished share, 0 to 1. Throws what `work` and `progress`
/// throw, and the exception of a signal's handler, such as KeyboardInterrupt; then the work has ended.
void run_long(const pybind11::object& progress, const std::function<void(const LongCall&)>& work);

/// The same for work that returns a value.
template <typename Work>
auto long_result(const pybind11::object& progress, Work&& work) {
    std::optional<decltype(work(LongCall{}))> result;
    run_long(progress, [&](const LongCall& call) { result.emplace(work(call)); });
    return std::move(*result);
}

}  // namespace rimline::python
