#pragma once

// Python's lock given up while the library works, so that other threads run.
//
// A thread that wants the lock back where the interpreter ends is ended by CPython before 3.14: pthread_exit() unwinds
// its stack. Destructors on the way would release Python's objects without the lock, or stop the program because they
// are noexcept. Here such a thread sleeps until the process ends, as with CPython 3.14. It must hold no other lock
// then. So take locks after an Unlocked, and in the same scope.

#include <pybind11/pybind11.h>

namespace rimline::python {

/// Gives up the interpreter's lock while it lives. Python's objects must not be touched meanwhile. The end of the
/// interpreter waits for what is done meanwhile.
class Unlocked {
public:
    Unlocked() noexcept;
    ~Unlocked();
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    PyThreadState* state_;
};

/// For a thread that the interpreter's end must not unwind. It holds no lock.
[[noreturn]] void sleep_until_exit() noexcept;

void bind_unlocked();

}  // namespace rimline::python
