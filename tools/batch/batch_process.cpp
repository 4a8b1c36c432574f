#include "tools/batch/batch_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "silhouette/error.h"
#include "tools/process/end_with_parent.h"

extern char** environ;

namespace rimline::tools {

namespace {

// Between SIGTERM, after which a process removes its temporary files, and SIGKILL.
constexpr std::chrono::seconds k_term_grace{2};

bool is_value_of(std::string_view setting, std::string_view variable) {
    return setting.starts_with(variable) && setting.substr(variable.size()).starts_with('=');
}

std::string last_line(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);  // npos + 1 is 0.
}

// Of the folder for temporary files ($TMPDIR, else /tmp); gone when it is closed. Null, and errno, if there is none.
std::FILE* open_temporary() {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "rimline-XXXXXX").string();
    if (error) {
        errno = error.value();
        return nullptr;
    }
    const int descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) return nullptr;
    unlink(name.c_str());
    return fdopen(descriptor, "w+");
}

// Between vfork() and exec(): what a system call does not change is the parent's. Returns the error.
int become_process(char* const* words, char* const* environment, int output, int error,
                   const BatchLimits& limits) {
    setpgid(0, 0);  // Ctrl-C reaches the batch alone, which ends its processes.
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    for (int signal = 1; signal < NSIG; ++signal) sigaction(signal, &usual, nullptr);
    const int input = open("/dev/null", O_RDONLY);
    if (input < 0 || dup2(input, 0) < 0 || dup2(output, 1) < 0 || dup2(error, 2) < 0) return errno;
    if (input > 2) close(input);
    if (limits.memory_bytes) {
        const rlimit limit{*limits.memory_bytes, *limits.memory_bytes};
        if (setrlimit(RLIMIT_AS, &limit) != 0) return errno;
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    execve("/proc/self/exe", words, environment);
    return errno;
}

// Returns 0 or the error. Not inlined: vfork() returns twice, and the caller's variables stay out of it.
[[gnu::noinline]] int start_process(pid_t& id, char* const* words, char* const* environment,
                                    int output, int error, const BatchLimits& limits) {
    // The child has the parent's memory until exec(): no handler of the parent may run in it.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    volatile int number = 0;
    id = vfork();
    if (id == 0) {
        number = become_process(words, environment, output, error, limits);
        _exit(127);
    }
    if (id < 0) {
        number = errno;
    } else if (number != 0) {
        waitpid(id, nullptr, 0);
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return number;
}

}  // namespace

BatchProcess::BatchProcess(const std::vector<std::string>& arguments, const BatchLimits& limits)
    : output_(open_temporary()), error_(open_temporary()), seconds_(limits.seconds) {
    const auto fail = [](const std::string& what, int number) {
        throw Error(ErrorCode::io, what + ": " + std::generic_category().message(number));
    };
    if (!output_ || !error_)
        fail("cannot make a temporary file (TMPDIR names another folder)", errno);
    std::vector<char*> words;
    std::string name = "rimline";
    words.push_back(name.data());
    std::vector<std::string> kept = arguments;
    for (std::string& argument : kept) words.push_back(argument.data());
    words.push_back(nullptr);
    // Mesa's CPU device starts threads of its own.
    const std::string threads = "LP_NUM_THREADS=" + std::to_string(limits.threads);
    const std::string parent = k_parent_variable + ("=" + std::to_string(getpid()));
    std::vector<char*> environment;
    for (char** variable = environ; *variable != nullptr; ++variable)
        if (!is_value_of(*variable, "LP_NUM_THREADS") && !is_value_of(*variable, k_parent_variable))
            environment.push_back(*variable);
    for (const std::string* variable : {&threads, &parent})
        environment.push_back(const_cast<char*>(variable->c_str()));
    environment.push_back(nullptr);

    const int number = start_process(id_, words.data(), environment.data(), fileno(output_.get()),
                                     fileno(error_.get()), limits);
    if (number != 0) {
        id_ = -1;
        fail("cannot start a process", number);
    }
}

BatchProcess::~BatchProcess() {
    if (id_ < 0) return;
    kill(id_, SIGTERM);
    const Clock::time_point deadline = Clock::now() + k_term_grace;
    while (waitpid(id_, nullptr, WNOHANG) == 0) {
        if (Clock::now() > deadline) kill(id_, SIGKILL);
        usleep(2000);
    }
}

std::optional<BatchEnd> BatchProcess::poll_end() {
    int status = 0;
    const pid_t ended = waitpid(id_, &status, WNOHANG);
    if (ended == 0) {
        const Clock::time_point now = Clock::now();
        if (is_over_time_) {
            if (now > kill_at_) kill(id_, SIGKILL);
        } else if (seconds_ && std::chrono::duration<double>(now - start_).count() > *seconds_) {
            is_over_time_ = true;
            kill_at_ = now + k_term_grace;
            kill(id_, SIGTERM);
        }
        return std::nullopt;
    }
    id_ = -1;
    BatchEnd end{.status = "ok",
                 .error = last_line(contents(error_.get())),
                 .output = contents(output_.get()),
                 .ms = std::chrono::duration<double, std::milli>(Clock::now() - start_).count()};
    if (is_over_time_) {
        end.status = "timeout";
        end.error = "it took more than its time";
    } else if (ended < 0) {
        end.status = "failed";
        end.error = "its end is not known";
    } else if (WIFSIGNALED(status)) {
        end.status = "crashed";
        end.error = std::string("ended by ") + strsignal(WTERMSIG(status)) +
                    (end.error.empty() ? "" : ": " + end.error);
    } else if (WEXITSTATUS(status) != 0) {
        end.status = WEXITSTATUS(status) == 2   ? "usage"
                     : WEXITSTATUS(status) == 3 ? "check"
                                                : "failed";
        // Where its message could not be written.
        if (end.error.empty())
            end.error = "it ended with status " + std::to_string(WEXITSTATUS(status));
    }
    return end;
}

std::string BatchProcess::contents(std::FILE* file) {
    std::string text;
    std::array<char, 1 << 14> buffer;
    off_t place = 0;
    for (;;) {
        const ssize_t size = pread(fileno(file), buffer.data(), buffer.size(), place);
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(size));
        place += size;
    }
}

}  // namespace rimline::tools
