#include "tools/output/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "silhouette/error.h"
#include "tools/command.h"
#include "tools/output/part_name.h"
#include "tools/output/summary_stream.h"

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

constexpr int k_max_attempts = 1000;

// By which another name can be given to a file that has none.
fs::path descriptor_path(const std::string& process, int descriptor) {
    return "/proc/" + process + "/fd/" + std::to_string(descriptor);
}

// -1 where the file system has no files without names, or this process could not name one.
int open_nameless(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0 || access(descriptor_path("self", descriptor).c_str(), F_OK) == 0)
        return descriptor;
    close(descriptor);
    return -1;
}

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
        throw FileError(path_.string(), "cannot write: it is a folder; name a file in it", EISDIR);
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
    folder_ = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    if (!fs::is_directory(folder_, error))
        throw FileError(
            path_.string(),
            "cannot write: there is no folder " + folder_.string() + "; create it first", ENOENT);
    if (exists && access(target_.c_str(), W_OK) != 0) fail("cannot write", errno);
    claim_.take(target_);
    remove_dead_parts(folder_);
    descriptor_ = open_nameless(folder_);
    // mkstemp would ignore the user's umask: its files are always private.
    if (descriptor_ < 0)
        make_part([&](const fs::path& part) {
            descriptor_ = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            return descriptor_ < 0 ? errno : 0;
        });
    lock_part(descriptor_);
    if (exists) fchmod(descriptor_, existing.st_mode & 07777);
}

OutputFile::~OutputFile() { close_descriptor(); }

// make(path) creates the temporary file's name.
template <typename Make>
void OutputFile::make_part(Make&& make) {
    for (int attempt = 0;; ++attempt) {
        const int error_number = part_.make(folder_ / part_name(target_, attempt), make);
        if (error_number == 0) return;
        if (error_number != EEXIST || attempt == k_max_attempts) fail("cannot write", error_number);
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
    if (!folder_.empty() && part_.path().empty()) {
        const fs::path nameless = descriptor_path("self", descriptor_);
        make_part([&](const fs::path& part) {
            return linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, part.c_str(), AT_SYMLINK_FOLLOW) ==
                           0
                       ? 0
                       : errno;
        });
    }
    // Some file systems report a full disk only in close().
    const int descriptor = std::exchange(descriptor_, -1);
    if (close(descriptor) != 0 && errno != EINTR) fail("cannot write", errno);
    if (folder_.empty()) return;
    if (const int error_number = part_.rename_to(target_); error_number != 0)
        fail("cannot write", error_number);
}

fs::path OutputFile::temporary() const {
    if (folder_.empty() || !part_.path().empty()) return part_.path();
    return descriptor_path(std::to_string(getpid()), descriptor_);
}

void OutputFile::fail(const std::string& problem, int error_number) const {
    throw FileError::of_system(path_.string(), problem, error_number);
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

}  // namespace rimline::tools
