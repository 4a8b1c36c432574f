#include "tools/output/film_file.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <vector>

#include "tools/command.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX has no header for it.

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_program = "ffmpeg";

bool is_installed() {
    const char* folders = std::getenv("PATH");
    std::string_view rest = folders != nullptr ? folders : "";
    while (!rest.empty()) {
        const std::size_t colon = std::min(rest.find(':'), rest.size());
        const fs::path file = fs::path(rest.substr(0, colon)) / k_program;
        if (access(file.c_str(), X_OK) == 0) return true;
        rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
    return false;
}

// Film formats of half the resolution in color take even sizes only: the last odd row or column is cut off.
constexpr const char* k_even = "crop=trunc(iw/2)*2:trunc(ih/2)*2,";
constexpr const char* k_bt709 = "scale=out_color_matrix=bt709:out_range=tv,format=";

std::vector<std::string> encoder(const std::string& ending, bool has_alpha) {
    if (ending == ".gif")
        return {"-filter_complex",
                "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a",
                "-loop",
                "0",
                "-f",
                "gif"};
    std::vector<std::string> options{
        "-vf",
        std::string(k_even) + k_bt709 + (has_alpha ? "yuva420p" : "yuv420p"),
        "-colorspace",
        "bt709",
        "-color_primaries",
        "bt709",
        "-color_trc",
        "bt709"};
    const std::vector<std::string> own =
        ending == ".mp4"
            ? std::vector<std::string>{"-c:v",   "libx264",   "-crf",       "16", "-preset",
                                       "medium", "-movflags", "+faststart", "-f", "mp4"}
            : std::vector<std::string>{"-c:v", "libvpx-vp9", "-crf", "24", "-b:v",
                                       "0",    "-row-mt",    "1",    "-f", "webm"};
    options.insert(options.end(), own.begin(), own.end());
    return options;
}

}  // namespace

bool is_film_ending(std::string_view ending) noexcept {
    return ending == ".mp4" || ending == ".gif" || ending == ".webm";
}

FilmFile::FilmFile(const fs::path& path, const std::string& ending, const FrameSinkOptions& options)
    : FrameSink(options.finish), file_(path) {
    if (ending == ".mp4" && options.finish.has_alpha)
        throw UsageError(
            "--background: an .mp4 is opaque; .webm, .gif, .apng and folders can be "
            "transparent");
    if (file_.temporary().empty())
        throw Error(ErrorCode::io, path.string() + ": ffmpeg writes films to regular files only");
    if (!is_installed())
        throw Error(ErrorCode::io, path.string() +
                                       ": needs ffmpeg, which is not installed: install the "
                                       "package ffmpeg, or write an .apng");
    try {
        start(ending, options);
    } catch (...) {
        if (messages_ != nullptr) std::fclose(messages_);
        throw;
    }
}

void FilmFile::start(const std::string& ending, const FrameSinkOptions& options) {
    const auto fail_by = [&](int error_number) {
        throw FileError::of_system(file_.path().string(), "cannot start ffmpeg", error_number);
    };
    messages_ = std::tmpfile();
    std::array<int, 2> ends{};
    if (messages_ == nullptr ||
        socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        fail_by(errno);
    const std::string size =
        std::to_string(options.size.width) + "x" + std::to_string(options.size.height);
    std::vector<std::string> words{k_program,
                                   "-loglevel",
                                   "error",
                                   "-nostats",
                                   "-y",
                                   "-f",
                                   "rawvideo",
                                   "-pix_fmt",
                                   "rgba",
                                   "-video_size",
                                   size,
                                   "-framerate",
                                   std::to_string(options.fps),
                                   "-i",
                                   "pipe:0"};
    for (const std::string& word : encoder(ending, options.finish.has_alpha)) words.push_back(word);
    words.push_back("file:" + file_.temporary().string());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(messages_), STDERR_FILENO);
    // A group of its own: Ctrl-C is for this program, which ends ffmpeg itself.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    const int error_number =
        posix_spawnp(&id_, k_program, &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    input_ = ends[0];
    if (error_number == 0) return;
    id_ = -1;
    close(input_);
    fail_by(error_number);
}

FilmFile::~FilmFile() {
    wait();
    if (input_ >= 0) close(input_);
    if (id_ > 0) {
        kill(id_, SIGKILL);
        wait_for_end();
    }
    if (messages_ != nullptr) std::fclose(messages_);
}

int FilmFile::wait_for_end() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
    id_ = -1;
    return status;
}

// Throws with the first line that ffmpeg wrote.
void FilmFile::fail() {
    std::array<char, 400> line{};
    std::rewind(messages_);
    if (std::fgets(line.data(), int{line.size()}, messages_) == nullptr) line[0] = '\0';
    std::string why = line.data();
    while (!why.empty() && why.back() == '\n') why.pop_back();
    throw Error(ErrorCode::io,
                file_.path().string() + ": ffmpeg failed" + (why.empty() ? "" : ": " + why));
}

void FilmFile::put(const Picture& picture, std::uint32_t) {
    std::string_view rest(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size());
    while (!rest.empty()) {
        const ssize_t sent = send(input_, rest.data(), rest.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) fail();
        rest.remove_prefix(static_cast<std::size_t>(sent));
    }
}

void FilmFile::end() {
    close(input_);
    input_ = -1;
    if (wait_for_end() != 0) fail();
    file_.commit();
}

}  // namespace rimline::tools
