#include "tools/bench_vtk.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/progress.h"
#include "tools/vtk_silhouette_script.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has no header for it.

namespace rimline::tools {

namespace {

// The first may be one of its own, without the system's packages.
constexpr std::array<const char*, 2> k_pythons{"python3", "/usr/bin/python3"};

struct CloseFile {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

template <typename Values>
bool write(std::FILE* file, const Values& values) {
    return std::fwrite(values.data(), sizeof(*values.data()), values.size(), file) == values.size();
}

// What the script reads, in a file without a name. Null where there is no room for it.
File script_input(const Mesh& mesh, std::span<const HomogeneousPoint> points,
                  std::uint32_t rounds) {
    File file(std::tmpfile());
    if (!file) return nullptr;
    std::vector<double> viewpoints;
    for (const HomogeneousPoint& point : points)
        viewpoints.insert(viewpoints.end(), {double{point.x}, double{point.y}, double{point.z}});
    const std::array<std::uint64_t, 4> counts{mesh.vertex_count(), mesh.face_count(), points.size(),
                                              rounds};
    const bool written = write(file.get(), counts) && write(file.get(), mesh.positions()) &&
                         write(file.get(), mesh.triangles()) && write(file.get(), viewpoints) &&
                         std::fflush(file.get()) == 0;
    return written ? std::move(file) : nullptr;
}

// A program that is gone when this object is.
class Child {
public:
    Child(const char* python, int input) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
        output_ = ends[0];
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        // This program's threads block the signals that are to end the other.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
        const std::array<const char*, 4> arguments{python, "-c", k_vtk_silhouette_script, nullptr};
        if (posix_spawnp(&id_, python, &actions, &attributes,
                         const_cast<char* const*>(arguments.data()), environ) != 0)
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
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }

    // All that it prints, when it has ended well; nothing when it has not, or could not be started.
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
        int status = 0;
        waitpid(id_, &status, 0);
        id_ = -1;
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
        return text;
    }

private:
    pid_t id_ = -1;
    int output_ = -1;
};

}  // namespace

VtkResult time_vtk(const Mesh& mesh, std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                   const Context& context) {
    VtkResult result;
    const File input = script_input(mesh, points, rounds);
    if (!input) {
        result.skipped = "no temporary file for it";
        return result;
    }
    Progress progress(context, "running VTK");
    progress.call().checkpoint(0.0);
    for (const char* python : k_pythons) {
        lseek(fileno(input.get()), 0, SEEK_SET);
        const std::optional<std::string> text = Child(python, fileno(input.get())).output(context);
        if (!text) continue;
        const auto object = nlohmann::json::parse(*text, nullptr, false);
        if (object.is_discarded() || !object.contains("us") || object["us"].size() != points.size())
            continue;
        result.version = object["version"];
        result.us = object["us"].get<std::vector<double>>();
        for (const double lines : object["lines"])
            result.mean_lines += lines / static_cast<double>(points.size());
        return result;
    }
    result.skipped = "no python3 that imports VTK 9 (Debian: python3-vtk9)";
    return result;
}

}  // namespace rimline::tools
