#include "silhouette/mesh/formats/source_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace rimline {

namespace {

class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const noexcept { return fd_; }

private:
    int fd_;
};

}  // namespace

SourceFile read_source_file(const std::filesystem::path& path, const LongCall& call) {
    SourceFile file{path.string(), {}, path.parent_path(), 0};
    // Without O_NONBLOCK, opening a pipe would wait for a writer.
    const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (descriptor.get() < 0) throw FileError::of_system(file.name, "cannot open it", errno);
    struct stat status {};
    if (::fstat(descriptor.get(), &status) != 0)
        throw FileError::of_system(file.name, "cannot read it", errno);
    if (S_ISDIR(status.st_mode))
        throw FileError(file.name, "is a directory; name a file in it", EISDIR);
    if (!S_ISREG(status.st_mode))
        throw FileError(file.name, "is not a regular file; copy its contents to one");

    constexpr std::size_t k_chunk = std::size_t{1} << 24;
    const auto expected = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
    // The size may be wrong, so reading continues until a read returns no bytes.
    constexpr std::size_t k_beyond = 4096;
    file.bytes.reserve(expected + k_beyond);
    for (;;) {
        const std::size_t had = file.bytes.size();
        const std::size_t want = expected > had ? std::min(k_chunk, expected - had) : k_beyond;
        file.bytes.resize(had + want);
        ssize_t got = 0;
        do got = ::read(descriptor.get(), file.bytes.data() + had, want);
        while (got < 0 && errno == EINTR);
        if (got < 0) throw FileError::of_system(file.name, "cannot read it", errno);
        file.bytes.resize(had + static_cast<std::size_t>(got));
        if (got == 0) break;
        const double whole = static_cast<double>(std::max(expected, file.bytes.size()));
        call.checkpoint(k_read_share * static_cast<double>(file.bytes.size()) / whole);
    }
    return file;
}

void bad_file(std::string_view name, const std::string& what) {
    throw Error(ErrorCode::bad_input, std::string(name) + ": " + what);
}

void bad_line(std::string_view name, std::uint64_t line, const std::string& what) {
    throw Error(ErrorCode::bad_input, std::string(name) + ":" + std::to_string(line) + ": " + what);
}

void bad_byte(std::string_view name, std::uint64_t offset, const std::string& what) {
    throw Error(ErrorCode::bad_input,
                std::string(name) + ": byte " + std::to_string(offset) + ": " + what);
}

std::string excerpt(std::string_view token) {
    constexpr std::size_t k_longest = 40;
    std::string text = "'";
    for (const char c : token.substr(0, k_longest)) text += (c >= 0x20 && c < 0x7f) ? c : '?';
    return text + (token.size() > k_longest ? "...'" : "'");
}

}  // namespace rimline
