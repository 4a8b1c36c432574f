#pragma once

// A limit of memory, and the shares that its users have taken. A share that does not fit is refused before
// anything is allocated, with an error that names the purpose, the size and the budget.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <utility>

#include "silhouette/error.h"

namespace rimline {

class MemoryBudget {
public:
    /// `name` is for messages: it names the budget and where it is set.
    MemoryBudget(std::uint64_t size_bytes, std::string name)
        : size_bytes_(size_bytes), name_(std::move(name)) {}
    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

    std::uint64_t size_bytes() const noexcept { return size_bytes_; }
    std::uint64_t used_bytes() const noexcept { return used_bytes_; }

    /// The share of one owner. Its destructor returns it. The budget must outlive it.
    class Share {
    public:
        /// An empty share. Null: without a budget, unlimited.
        explicit Share(MemoryBudget* budget = nullptr) noexcept : budget_(budget) {}
        Share(Share&& other) noexcept
            : budget_(other.budget_), bytes_(std::exchange(other.bytes_, 0)) {}
        Share& operator=(Share&& other) noexcept {
            std::swap(budget_, other.budget_);
            std::swap(bytes_, other.bytes_);
            return *this;
        }
        ~Share() {
            if (budget_) budget_->used_bytes_ -= bytes_;
        }

        /// Sets the share to `bytes`. Throws Error{too_large} naming `what` and the budget; then nothing has
        /// changed.
        void resize(std::uint64_t bytes, const std::string& what) {
            if (budget_) {
                if (bytes > bytes_) budget_->check(bytes - bytes_, what);
                budget_->used_bytes_ += bytes - bytes_;
            }
            bytes_ = bytes;
        }
        std::uint64_t bytes() const noexcept { return bytes_; }

    private:
        MemoryBudget* budget_;
        std::uint64_t bytes_ = 0;
    };

private:
    void check(std::uint64_t more_bytes, const std::string& what) const;

    std::uint64_t size_bytes_;
    std::uint64_t used_bytes_ = 0;
    std::string name_;
};

/// As vk_check(). If memory has run out, the error names `what`, which needed `size_bytes`.
void check_room(VkResult result, const char* call, std::uint64_t size_bytes,
                const std::string& what);

/// A size for messages: "12 MiB", "1.5 KiB".
std::string size_text(std::uint64_t bytes);

}  // namespace rimline
