#include "tools/bench/python_script.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>
#include <vector>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has no header for it.

namespace rimline::tools {

namespace {

constexpr std::array<const char*, 2> k_pythons{"python3", "/usr/bin/python3"};
constexpr std::chrono::seconds k_grace{2};
constexpr std::chrono::milliseconds k_moment{5};

// A running program. The destructor ends it.
class Child {
public:
    Child(std::span<const char* const> arguments, int input) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
        output_ = ends[0];
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        // This program's threads block the signals that end the child; the child must not inherit that.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes, &none);
        sigset_t termination = none;
        sigaddset(&termination, SIGTERM);
        posix_spawnattr_setsigdefault(&attributes, &termination);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        std::vector<const char*> ended(arguments.begin(), arguments.end());
        ended.push_back(nullptr);
        if (posix_spawnp(&id_, ended.front(), &actions, &attributes,
                         const_cast<char* const*>(ended.data()), environ) != 0)
            id_ = -1;
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (output_ >= 0) close(output_);
        if (id_ < 0) return;
        kill(id_, SIGTERM);  // The script can remove its temporary files.
        const auto deadline = std::chrono::steady_clock::now() + k_grace;
        while (!has_ended() && std::chrono::steady_clock::now() < deadline)
            std::this_thread::sleep_for(k_moment);
        if (id_ < 0) return;
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }

    // Its whole output if it ended with status 0; nothing if it did not, or could not be started.
    std::optional<std::string> output(const Context& context) {
        if (id_ < 0) return std::nullopt;
        std::string text;
        std::array<char, 4096> buffer;
        for (;;) {
            context.checkpoint();
            pollfd readable{output_, POLLIN, 0};
            if (poll(&readable, 1, 100) <= 0) continue;
            const ssize_t size = read(output_, buffer.data(), buffer.size());
            if (size <= 0) break;
            text.append(buffer.data(), static_cast<std::size_t>(size));
        }
        while (!has_ended()) {
            context.checkpoint();
            std::this_thread::sleep_for(k_moment);
        }
        if (!WIFEXITED(status_) || WEXITSTATUS(status_) != 0) return std::nullopt;
        return text;
    }

private:
    bool has_ended() {
        if (id_ >= 0 && waitpid(id_, &status_, WNOHANG) == id_) id_ = -1;
        return id_ < 0;
    }

    pid_t id_ = -1;
    int status_ = 0;
    int output_ = -1;
};

}  // namespace

std::optional<std::string> run_python(const char* script, ScriptInput& input,
                                      const Context& context) {
    for (const char* python : k_pythons)
        if (auto text = run_program(std::array{python, "-c", script}, input, context)) return text;
    return std::nullopt;
}

std::optional<std::string> run_program(std::span<const char* const> arguments, ScriptInput& input,
                                       const Context& context) {
    lseek(fileno(input.file()), 0, SEEK_SET);
    return Child(arguments, fileno(input.file())).output(context);
}

}  // namespace rimline::tools
