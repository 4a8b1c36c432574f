#include "tools/python/long_calls.h"

#include <cxxabi.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace rimline::python {

namespace py = pybind11;

namespace {

using namespace std::chrono_literals;

constexpr auto k_wake_up = 20ms;
constexpr auto k_patience = 20ms;  // With the time to wake up, well below a tenth of a second.

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

// Work on a thread of its own, shared by that thread and the calling one.
struct Work {
    std::function<void(const LongCall&)> function;
    std::stop_source stop;
    std::atomic<double> share{0.0};
    std::mutex mutex;
    std::condition_variable ends;
    bool has_ended = false;
    std::exception_ptr failure;

    void run() noexcept {
        try {
            // Parts of the work may each begin at 0.
            function(
                {stop.get_token(), [this](double done) { share = std::max(share.load(), done); }});
        } catch (...) {
            failure = std::current_exception();
        }
        function = nullptr;  // Here, and not where the interpreter's lock is held.
        const std::lock_guard lock(mutex);
        has_ended = true;
        ends.notify_all();
    }
    template <typename Duration>
    bool ends_within(Duration duration) {
        std::unique_lock lock(mutex);
        return ends.wait_for(lock, duration, [&] { return has_ended; });
    }
    void wait() {
        std::unique_lock lock(mutex);
        ends.wait(lock, [&] { return has_ended; });
    }
};

// Work that was left alone. A child of fork() has none of its threads.
struct LeftWork {
    pid_t process = getpid();
    std::mutex mutex;
    std::vector<std::shared_ptr<Work>> works;

    void add(const std::shared_ptr<Work>& work) {
        const std::lock_guard lock(mutex);
        std::erase_if(works, [](const auto& other) { return other->ends_within(0ms); });
        works.push_back(work);
    }
    void wait() {
        if (process != getpid()) return;
        const std::lock_guard lock(mutex);
        for (const std::shared_ptr<Work>& work : works) work->wait();
        works.clear();
    }
};
LeftWork& left_works() {
    static LeftWork left;
    return left;
}

// Waits for `work` after a stop; at most `patience`, if given.
void stop_work(const std::shared_ptr<Work>& work,
               std::optional<std::chrono::milliseconds> patience) {
    work->stop.request_stop();
    if (!patience)
        work->wait();
    else if (!work->ends_within(*patience))
        left_works().add(work);
}

void run(const py::object& progress, std::function<void(const LongCall&)> function,
         std::optional<std::chrono::milliseconds> patience) {
    ShownProgress shown(progress);
    const auto work = std::make_shared<Work>();
    work->function = std::move(function);
    std::thread([work] { work->run(); }).detach();
    std::exception_ptr interruption;
    try {
        for (bool is_over = false; !is_over;) {
            // Not by a destructor: where the interpreter ends, this thread ends in PyEval_RestoreThread().
            PyThreadState* const state = PyEval_SaveThread();
            is_over = work->ends_within(k_wake_up);
            PyEval_RestoreThread(state);
            if (is_over) break;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            shown.show(work->share);
        }
    } catch (abi::__forced_unwind&) {
        stop_work(work, std::nullopt);  // The interpreter waits no more.
        shown.abandon();
        throw;
    } catch (...) {
        interruption = std::current_exception();
        PyThreadState* const state = PyEval_SaveThread();
        stop_work(work, patience);
        PyEval_RestoreThread(state);
    }
    const std::exception_ptr failure = interruption ? interruption : work->failure;
    if (!failure) shown.show(1.0);
    shown.close();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

void run_long(const py::object& progress, const std::function<void(const LongCall&)>& work) {
    run(
        progress, [&work](const LongCall& call) { work(call); }, std::nullopt);
}

void run_long_apart(const py::object& progress, std::function<void(const LongCall&)> work) {
    run(progress, std::move(work), k_patience);
}

void bind_long_calls(py::module_& module) {
    left_works();
    module.def(
        "_wait_for_left_work", [] { left_works().wait(); },
        py::call_guard<py::gil_scoped_release>());
    py::module_::import("atexit").attr("register")(module.attr("_wait_for_left_work"));
}

}  // namespace rimline::python
