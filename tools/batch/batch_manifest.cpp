#include "tools/batch/batch_manifest.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "silhouette/error.h"

namespace rimline::tools {

namespace {

[[noreturn]] void fail_manifest(const std::filesystem::path& path, const char* what) {
    throw Error(ErrorCode::io,
                path.string() + ": cannot " + what + ": " + std::generic_category().message(errno));
}

}  // namespace

BatchManifest::BatchManifest(const std::filesystem::path& path) : path_(path) {
    descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_manifest(path, "write");
    try {
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK)
                throw Error(ErrorCode::io, path.string() +
                                               ": another batch writes it: wait, or take another "
                                               "--output or --shard");
            fail_manifest(path, "lock");
        }
        std::string text;
        std::array<char, 1 << 16> buffer;
        for (;;) {
            const ssize_t size = ::read(descriptor_, buffer.data(), buffer.size());
            if (size < 0 && errno == EINTR) continue;
            if (size < 0) fail_manifest(path, "read");
            if (size == 0) break;
            text.append(buffer.data(), static_cast<std::size_t>(size));
        }
        const std::size_t whole = text.rfind('\n') + 1;  // 0 where there is none.
        if (whole != text.size()) {
            if (ftruncate(descriptor_, static_cast<off_t>(whole)) != 0)
                fail_manifest(path, "write");
            text.resize(whole);
        }
        read(text);
    } catch (...) {
        close(descriptor_);
        throw;
    }
}

BatchManifest::~BatchManifest() { close(descriptor_); }

void BatchManifest::read(const std::string& text) {
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        const auto line = nlohmann::ordered_json::parse(
            text.begin() + static_cast<std::ptrdiff_t>(begin),
            text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        ++number;
        begin = end + 1;
        try {
            take(line);
        } catch (const nlohmann::json::exception&) {
            throw Error(ErrorCode::bad_input, path_.string() + ":" + std::to_string(number) +
                                                  ": no entry of a batch: take another --output");
        }
    }
}

void BatchManifest::take(const nlohmann::ordered_json& line) {
    BatchEntry entry{.digest = line.at("digest"),
                     .command = line.at("command"),
                     .status = line.at("status"),
                     .error = line.at("error").is_null() ? "" : line.at("error").get<std::string>(),
                     .outputs = line.at("outputs"),
                     .ms = line.at("ms")};
    entries_.insert_or_assign(line.at("input"), std::move(entry));
}

const BatchEntry* BatchManifest::find(const std::string& input) const {
    const auto found = entries_.find(input);
    return found == entries_.end() ? nullptr : &found->second;
}

void BatchManifest::append(const nlohmann::ordered_json& entry) {
    const std::string line =
        entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    for (std::size_t written = 0; written < line.size();) {
        const ssize_t size = write(descriptor_, line.data() + written, line.size() - written);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) fail_manifest(path_, "write");
        written += static_cast<std::size_t>(size);
    }
    take(entry);
}

}  // namespace rimline::tools
