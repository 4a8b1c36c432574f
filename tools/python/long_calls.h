#pragma once

// Long calls of the library from Python: other Python threads run meanwhile, Ctrl-C stops them, and progress is shown.
//
// The work runs on a thread of its own. The calling thread sleeps without the interpreter's lock and wakes fifty times
// a second, to let Python handle signals and to report progress. So Python's code runs on the calling thread alone.

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "silhouette/error.h"

namespace rimline::python {

/// Calls work(call) without the interpreter's lock; it must not touch Python's objects. `progress` is None, True (a bar
/// of tqdm), a bar of tqdm, or a function that takes the finished share, 0 to 1. Throws what `work` and `progress`
/// throw, and the exception of a signal's handler, such as KeyboardInterrupt; then the work has ended.
/// Where the interpreter ends, the work is stopped, its end is waited for, and the calling thread never returns.
void run_long(const pybind11::object& progress, const std::function<void(const LongCall&)>& work);

/// The same for work that does not end at once, as where it waits for a device: after an exception it is left alone, to
/// end on its own thread. So it owns what it touches. The end of the interpreter waits for it.
void run_long_apart(const pybind11::object& progress, std::function<void(const LongCall&)> work);

/// run_long() for work that returns a value.
template <typename Work>
auto long_result(const pybind11::object& progress, Work&& work) {
    std::optional<decltype(work(LongCall{}))> result;
    run_long(progress, [&](const LongCall& call) { result.emplace(work(call)); });
    return std::move(*result);
}

/// run_long_apart() for work that returns a value.
template <typename Work>
auto long_result_apart(const pybind11::object& progress, Work work) {
    auto result = std::make_shared<std::optional<decltype(work(LongCall{}))>>();
    run_long_apart(progress, [result, work = std::move(work)](const LongCall& call) {
        result->emplace(work(call));
    });
    return std::move(**result);
}

void bind_long_calls(pybind11::module_& module);

}  // namespace rimline::python
