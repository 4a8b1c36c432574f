#include "tools/python/long_calls.h"

#include <cxxabi.h>
#include <pthread.h>

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

#include "tools/python/unlocked.h"

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

    // The interpreter may end while these run Python's code. So they have no objects whose destructors need its lock.
    void show(double share) {
        if (share <= shown_) return;
        if (function_) release(PyObject_CallFunction(function_.ptr(), "d", share));
        if (bar_) {
            PyObject* const number = PyObject_GetAttrString(bar_.ptr(), "total");
            const double total = number == nullptr ? -1.0 : PyFloat_AsDouble(number);
            Py_XDECREF(number);
            if (PyErr_Occurred() != nullptr) throw py::error_already_set();
            release(PyObject_CallMethod(bar_.ptr(), "update", "d",
                                        total * (share - std::max(shown_, 0.0))));
        }
        shown_ = share;
    }
    void close() {
        if (closes_bar_) release(PyObject_CallMethod(bar_.ptr(), "close", nullptr));
    }

private:
    static constexpr const char* k_format = "{percentage:3.0f}%|{bar}| {elapsed}";

    static void release(PyObject* result) {
        if (result == nullptr) throw py::error_already_set();
        Py_DECREF(result);
    }

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
    std::atomic<bool> is_left = false;  // It ends by itself.
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
        end();
    }
    void end() noexcept {
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

bool ends_soon(Work& work) {
    const Unlocked unlocked;
    return work.ends_within(k_wake_up);
}

// Work that has not ended.
class RunningWorks {
public:
    void add(const std::shared_ptr<Work>& work) {
        const std::lock_guard lock(mutex_);
        std::erase_if(works_, [](const auto& other) { return other->ends_within(0ms); });
        works_.push_back(work);
    }
    void stop() {
        for (const std::shared_ptr<Work>& work : all()) work->stop.request_stop();
    }
    void wait_for_left() {
        for (const std::shared_ptr<Work>& work : all())
            if (work->is_left) work->wait();
    }
    void wait() {
        for (const std::shared_ptr<Work>& work : all()) work->wait();
    }

private:
    std::vector<std::shared_ptr<Work>> all() {
        const std::lock_guard lock(mutex_);
        return works_;
    }

    std::mutex mutex_;
    std::vector<std::shared_ptr<Work>> works_;
};

// Never freed: work may outlive static objects. A child of fork() has none of the threads, and its own list.
RunningWorks* g_works = new RunningWorks;

// Waits for `work` after a stop; at most `patience`, if given.
void stop_work(Work& work, std::optional<std::chrono::milliseconds> patience) {
    work.stop.request_stop();
    if (!patience)
        work.wait();
    else if (!work.ends_within(*patience))
        work.is_left = true;
}

// Calls call(), which runs Python's code. Where the interpreter ends in it, bind_long_calls() has the work stopped.
template <typename Call>
void in_python(Call call) {
    try {
        call();
    } catch (abi::__forced_unwind&) {
        sleep_until_exit();
    }
}

void run(const py::object& progress, std::function<void(const LongCall&)> function,
         std::optional<std::chrono::milliseconds> patience) {
    ShownProgress shown(progress);
    const auto work = std::make_shared<Work>();
    work->function = std::move(function);
    // First, because it may throw: what runs is stopped only as one of them.
    g_works->add(work);
    try {
        std::thread([work] { work->run(); }).detach();
    } catch (...) {
        work->end();
        throw;
    }
    std::exception_ptr interruption;
    try {
        while (!ends_soon(*work))
            in_python([&] {
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                shown.show(work->share);
            });
    } catch (...) {
        interruption = std::current_exception();
        const Unlocked unlocked;
        stop_work(*work, patience);
    }
    const std::exception_ptr failure = interruption ? interruption : work->failure;
    if (!failure) in_python([&] { shown.show(1.0); });
    in_python([&] { shown.close(); });
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
    module.def("_wait_for_left_work", [] {
        const Unlocked unlocked;
        g_works->wait_for_left();
    });
    py::module_::import("atexit").attr("register")(module.attr("_wait_for_left_work"));
    // Threads that called for the other work sleep by now, and no longer stop it.
    Py_AtExit([] {
        g_works->stop();
        g_works->wait();
    });
    pthread_atfork(nullptr, nullptr, [] { g_works = new RunningWorks; });
}

}  // namespace rimline::python
