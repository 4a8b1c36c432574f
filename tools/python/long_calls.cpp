#include "tools/python/long_calls.h"

#include <cxxabi.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace rimline::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds k_wake_up{20};

// Shows shares by whatever the caller gave.
class ShownProgress {
public:
    explicit ShownProgress(const py::object& progress) {
        if (progress.is_none() || progress.is(py::bool_(false))) return;
        if (progress.is(py::bool_(true))) {
            bar_ = py::module_::import("tqdm.auto")
                       .attr("tqdm")(py::arg("total") = 1.0, py::arg("bar_format") = k_format);
            closes_bar_ = true;
        } else if (py::hasattr(progress, "update") && py::hasattr(progress, "n")) {
            bar_ = progress;
            if (bar_.attr("total").is_none()) bar_.attr("total") = 1.0;
        } else if (PyCallable_Check(progress.ptr()) != 0) {
            function_ = progress;
        } else {
            throw py::type_error(
                "progress: expected None, True, a bar of tqdm, or a function that takes a share");
        }
    }

    void show(double share) {
        if (share <= shown_) return;
        if (function_) function_(share);
        if (bar_) {
            const double total = bar_.attr("total").cast<double>();
            bar_.attr("update")(total * (share - std::max(shown_, 0.0)));
        }
        shown_ = share;
    }
    void close() {
        if (closes_bar_) bar_.attr("close")();
    }
    /// Gives up Python's objects where the interpreter ends: they cannot be released any more.
    void abandon() noexcept {
        bar_.release();
        function_.release();
    }

private:
    static constexpr const char* k_format = "{percentage:3.0f}%|{bar}| {elapsed}";

    py::object bar_, function_;
    bool closes_bar_ = false;
    double shown_ = -1.0;
};

}  // namespace

void run_long(const py::object& progress, const std::function<void(const LongCall&)>& work) {
    ShownProgress shown(progress);
    std::stop_source stop;
    std::atomic<double> share{0.0};
    std::mutex mutex;
    std::condition_variable ends;
    bool has_ended = false;
    std::exception_ptr failure;
    std::thread worker([&] {
        try {
            // Parts of the work may each begin at 0.
            work({stop.get_token(), [&](double done) { share = std::max(share.load(), done); }});
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        has_ended = true;
        ends.notify_one();
    });
    std::exception_ptr interruption;
    try {
        for (bool is_over = false; !is_over;) {
            // Not by a destructor: where the interpreter ends, this thread ends in PyEval_RestoreThread().
            PyThreadState* const state = PyEval_SaveThread();
            {
                std::unique_lock lock(mutex);
                is_over = ends.wait_for(lock, k_wake_up, [&] { return has_ended; });
            }
            PyEval_RestoreThread(state);
            if (is_over) break;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            shown.show(share);
        }
    } catch (abi::__forced_unwind&) {
        stop.request_stop();
        worker.join();
        shown.abandon();
        throw;
    } catch (...) {
        interruption = std::current_exception();
        stop.request_stop();
    }
    PyThreadState* const state = PyEval_SaveThread();
    worker.join();
    PyEval_RestoreThread(state);
    if (!interruption && !failure) shown.show(1.0);
    shown.close();
    if (interruption) std::rethrow_exception(interruption);
    if (failure) std::rethrow_exception(failure);
}

}  // namespace rimline::python
