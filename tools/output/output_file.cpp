#include "tools/output/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <system_error>
#include <utility>

#include "silhouette/error.h"
#include "tools/command.h"
#include "tools/output/summary_stream.h"

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

// Guards the list of files that have a temporary file, and the creation and removal of these.
std::mutex g_mutex;
OutputFile* g_first = nullptr;

}  // namespace

OutputFile::OutputFile(fs::path path, const fs::path& model)
    : path_(std::move(path)), target_(path_) {
    if (path_.empty()) throw Error(ErrorCode::io, "the output file's name is empty");
    if (path_ == k_standard_output) {
        if (isatty(STDOUT_FILENO) == 1)
            throw UsageError("-o -: standard output is a terminal; send it to a file or program");
        path_ = "standard output";
        descriptor_ = dup(STDOUT_FILENO);
        if (descriptor_ < 0) fail("cannot write", errno);
        move_summary_to_standard_error();
        return;
    }
    if (is_same_file(path_, model))
        throw UsageError(path_.string() + ": this is the model itself; name another file to write");
    struct stat existing {};
    const bool exists = stat(path_.c_str(), &existing) == 0;
    if (!exists && errno == ELOOP) fail("cannot follow the link", ELOOP);
    if (exists && S_ISDIR(existing.st_mode))
        throw Error(ErrorCode::io,
                    path_.string() + ": cannot write: it is a folder; name a file in it");
    if (exists && !S_ISREG(existing.st_mode)) {
        // Open the link, not its target: the target of /dev/stdout may have no name.
        descriptor_ = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail("cannot write", errno);
        return;
    }

    std::error_code error;
    while (fs::is_symlink(target_, error)) {
        target_ = target_.parent_path() / fs::read_symlink(target_, error);
        if (error) fail("cannot follow the link", error.value());
    }
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw Error(ErrorCode::io, path_.string() + ": cannot write: there is no folder " +
                                       folder.string() + "; create it first");
    if (exists && access(target_.c_str(), W_OK) != 0) fail("cannot write", errno);
    const std::lock_guard lock(g_mutex);
    // mkstemp would ignore the user's umask: its files are always private.
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
        std::string name(".");
        name.append(target_.filename().string()).append(".").append(std::to_string(getpid()));
        name.append(".").append(std::to_string(attempt)).append(".part");
        temporary_ = folder / name;
        descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0 || (errno == EEXIST && attempt < 1000)) continue;
        const int error_number = errno;
        temporary_.clear();
        fail("cannot write", error_number);
    }
    if (exists) fchmod(descriptor_, existing.st_mode & 07777);
    next_ = std::exchange(g_first, this);
}

OutputFile::~OutputFile() {
    close_descriptor();
    const std::lock_guard lock(g_mutex);
    if (!temporary_.empty()) unlink(temporary_.c_str());
    for (OutputFile** link = &g_first; *link != nullptr; link = &(*link)->next_)
        if (*link == this) {
            *link = next_;
            break;
        }
}

void OutputFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("cannot write", errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void OutputFile::commit() {
    // Some file systems report a full disk only in close().
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0 && errno != EINTR) fail("cannot write", errno);
    const std::lock_guard lock(g_mutex);
    if (temporary_.empty()) return;
    if (rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot write", errno);
    temporary_.clear();
}

void OutputFile::fail(const std::string& problem, int error_number) const {
    throw Error(ErrorCode::io, path_.string() + ": " + problem + ": " +
                                   std::generic_category().message(error_number));
}

void OutputFile::close_descriptor() noexcept {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
}

void check_output(const Context& context, const std::string& output) {
    if (context.json && output == k_standard_output)
        throw UsageError(
            "--json: standard output is that of the file with -o -; leave out one of them");
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::equivalent(a, b, ignored);
}

void remove_temporary_files() noexcept {
    const std::lock_guard lock(g_mutex);
    for (const OutputFile* file = g_first; file != nullptr; file = file->next_)
        if (!file->temporary_.empty()) unlink(file->temporary_.c_str());
}

}  // namespace rimline::tools
