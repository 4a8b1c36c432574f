#pragma once

// Whether a call stops the program, as RIMLINE_CHECK does for a mistake of the caller.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace rimline::tests {

/// Calls in a child process, which has this thread alone: the call must not need others. Its messages are not shown.
template <typename Call>
bool stops(const Call& call) {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        std::signal(SIGABRT, SIG_DFL);
        dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
        call();
        _exit(0);
    }
    int status = 0;
    if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
}

}  // namespace rimline::tests
