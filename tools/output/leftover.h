#pragma once

// A file or a new folder that nobody shall find if the program ends before it is complete.
//
// Destructors remove it when an exception ends the work. Where a program ends without its destructors, because
// one of its threads ends it while the others run, remove_leftovers() removes all that there are.

#include <filesystem>
#include <mutex>
#include <utility>

namespace rimline::tools {

class Leftover {
public:
    Leftover() = default;
    /// Removes it. A folder that is not empty stays.
    ~Leftover();
    Leftover(const Leftover&) = delete;
    Leftover& operator=(const Leftover&) = delete;

    /// Calls make(path), which creates the file or folder and returns 0, or creates nothing and returns the
    /// number of the error, and returns the same. It is called at most once for an object that owns nothing.
    template <typename Make>
    int make(std::filesystem::path path, Make&& make) {
        const std::lock_guard lock(mutex());
        const int error_number = make(path);
        if (error_number == 0) own(std::move(path));
        return error_number;
    }

    /// Gives a file its name, in place of an older file, and owns it no longer. Returns 0, or the number of the
    /// error.
    int rename_to(const std::filesystem::path& target) noexcept;

    /// Empty if there is nothing to remove.
    const std::filesystem::path& path() const noexcept { return path_; }

private:
    friend void remove_leftovers() noexcept;
    static std::mutex& mutex() noexcept;
    void own(std::filesystem::path path) noexcept;
    void disown() noexcept;

    std::filesystem::path path_;
    Leftover* next_ = nullptr;  // In the list of those that own something; the latest is the first.
};

/// Removes what all objects own, the latest first. For a thread that ends the program while other threads run.
void remove_leftovers() noexcept;

}  // namespace rimline::tools
