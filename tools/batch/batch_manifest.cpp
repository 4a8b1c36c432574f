#include "tools/batch/batch_manifest.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

namespace rimline::tools {

namespace {

constexpr std::chrono::milliseconds k_lock_poll{50};

[[noreturn]] void fail_manifest(const std::filesystem::path& path, const char* what) {
    throw FileError::of_system(path.string(), std::string("cannot ") + what, errno);
}

}  // namespace

BatchManifest::BatchManifest(const std::filesystem::path& path, const LongCall* wait)
    : BatchManifest(path, wait, true) {}

BatchManifest BatchManifest::as_it_is(const std::filesystem::path& path) {
    return BatchManifest(path, nullptr, false);
}

BatchManifest::BatchManifest(const std::filesystem::path& path, const LongCall* wait,
                             bool is_written)
    : path_(path) {
    const int access = is_written ? O_RDWR | O_CREAT | O_APPEND : O_RDONLY;
    descriptor_ = open(path.c_str(), access | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_manifest(path, is_written ? "write" : "read");
    try {
        if (is_written) lock(wait);
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
            if (is_written && ftruncate(descriptor_, static_cast<off_t>(whole)) != 0)
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

void BatchManifest::lock(const LongCall* wait) const {
    while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (errno != EWOULDBLOCK) fail_manifest(path_, "lock");
        if (wait == nullptr)
            throw Error(ErrorCode::io, path_.string() +
                                           ": another batch writes it: use --wait, or another "
                                           "--output or --shard");
        wait->checkpoint(0.0);
        std::this_thread::sleep_for(k_lock_poll);
    }
}

void BatchManifest::read(const std::string& text) {
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        const auto line = nlohmann::ordered_json::parse(
            text.begin() + static_cast<std::ptrdiff_t>(begin),
            text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        ++number;
        try {
            take(line, end - begin);
        } catch (const nlohmann::json::exception&) {
            throw Error(ErrorCode::bad_input, path_.string() + ":" + std::to_string(number) +
                                                  ": no entry of a batch: take another --output");
        }
        begin = end + 1;
    }
}

void BatchManifest::take(const nlohmann::ordered_json& line, std::uint64_t size) {
    BatchEntry entry{.digest = line.at("digest"),
                     .command = line.at("command"),
                     .status = line.at("status"),
                     .error = line.at("error").is_null() ? "" : line.at("error").get<std::string>(),
                     .outputs = line.at("outputs"),
                     .ms = line.at("ms"),
                     .begin = size_,
                     .size = size};
    entries_.insert_or_assign(line.at("input"), std::move(entry));
    size_ += size + 1;
}

const BatchEntry* BatchManifest::find(const std::string& input) const {
    const auto found = entries_.find(input);
    return found == entries_.end() ? nullptr : &found->second;
}

std::string BatchManifest::line(const BatchEntry& entry) const {
    std::string text(entry.size, '\0');
    for (std::size_t known = 0; known < text.size();) {
        const ssize_t size = pread(descriptor_, text.data() + known, text.size() - known,
                                   static_cast<off_t>(entry.begin + known));
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) fail_manifest(path_, "read");
        if (size == 0) throw Error(ErrorCode::io, path_.string() + ": another program cut it");
        known += static_cast<std::size_t>(size);
    }
    return text;
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
    take(entry, line.size() - 1);
}

}  // namespace rimline::tools
