#include "tools/output/part_name.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view k_part_ending = ".part";
// Of the target's name: with the numbers behind it, names have at most 255 bytes.
constexpr std::size_t k_max_stem = 220;

// Takes .NUMBER from the end of `text`, or nothing.
std::optional<pid_t> take_number(std::string_view& text) {
    const std::size_t point = text.rfind('.');
    if (point == std::string_view::npos) return std::nullopt;
    const std::string_view digits = text.substr(point + 1);
    pid_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size() || number < 0)
        return std::nullopt;
    text = text.substr(0, point);
    return number;
}

// The process of a part file; nothing if the name is of another kind.
std::optional<pid_t> process_of(std::string_view name) {
    if (!name.starts_with('.') || !name.ends_with(k_part_ending)) return std::nullopt;
    name.remove_suffix(k_part_ending.size());
    if (!take_number(name)) return std::nullopt;
    const std::optional<pid_t> process = take_number(name);
    return process && *process > 0 && name.size() > 1 ? process : std::nullopt;
}

// A process that has ended keeps its number until its parent asks for it, which may take long or never come.
bool is_zombie(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(file, text);
    const std::size_t name_end = text.rfind(") ");
    return name_end != std::string::npos && text.compare(name_end + 2, 1, "Z") == 0;
}

bool has_process_ended(pid_t process) {
    return (kill(process, 0) != 0 && errno == ESRCH) || is_zombie(process);
}

bool is_locked(const fs::path& file) {
    const int descriptor = open(file.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return true;
    const bool is_free = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    close(descriptor);
    return !is_free;
}

void remove_dead_parts_in(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> seen;
    const std::lock_guard lock(mutex);
    if (!seen.insert(fs::absolute(folder)).second) return;
    // The standard library's iterator ends the program where there is no memory for it.
    const std::unique_ptr<DIR, int (*)(DIR*)> opened(opendir(folder.empty() ? "." : folder.c_str()),
                                                     closedir);
    if (!opened) return;
    while (const dirent* const entry = readdir(opened.get())) {
        const std::optional<pid_t> process = process_of(entry->d_name);
        if (!process || !has_process_ended(*process)) continue;
        const fs::path path = folder / entry->d_name;
        std::error_code ignored;
        if (fs::symlink_status(path, ignored).type() == fs::file_type::regular && !is_locked(path))
            fs::remove(path, ignored);
    }
}

}  // namespace

std::string part_name(const fs::path& target, int attempt) {
    std::string name = "." + target.filename().string();
    if (name.size() > k_max_stem) {
        // Some file systems take whole characters of UTF-8 alone.
        std::size_t end = k_max_stem;
        while (end > k_max_stem - 3 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80)
            --end;
        name.resize(end);
    }
    name.append(".").append(std::to_string(getpid()));
    return name.append(".").append(std::to_string(attempt)).append(k_part_ending);
}

void lock_part(int descriptor) noexcept { flock(descriptor, LOCK_EX | LOCK_NB); }

void remove_dead_parts(const fs::path& folder) noexcept {
    try {
        remove_dead_parts_in(folder);
    } catch (const std::exception&) {
    }
}

}  // namespace rimline::tools
