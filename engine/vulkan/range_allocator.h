#pragma once

// Parts of one range of addresses, as of a large block of memory: handed out, taken back and joined again.
//
// Free parts lie in bins by the power of two below their size. A part is taken from the first bin whose parts are
// all large enough, or from the bin before it where one fits: O(parts in that bin). Taking back is O(1), and
// never allocates.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace rimline {

class RangeAllocator {
public:
    /// One part; its address is its name until it is taken back.
    class Part {
    public:
        std::uint64_t offset() const noexcept { return offset_; }
        std::uint64_t size() const noexcept { return size_; }

    private:
        friend class RangeAllocator;
        std::uint64_t offset_ = 0;
        std::uint64_t size_ = 0;
        bool is_free_ = false;
        Part* below_ = nullptr;  // Its neighbors by offset; the one above is owned.
        std::unique_ptr<Part> above_;
        Part* previous_ = nullptr;  // Its neighbors in the bin.
        Part* next_ = nullptr;
    };

    explicit RangeAllocator(std::uint64_t size);
    ~RangeAllocator();
    RangeAllocator(const RangeAllocator&) = delete;
    RangeAllocator& operator=(const RangeAllocator&) = delete;

    /// A part of `size` > 0 whose offset is a multiple of `alignment`, a power of two. Null where no free part
    /// holds one.
    Part* allocate(std::uint64_t size, std::uint64_t alignment);
    void free(Part& part) noexcept;

    std::uint64_t size() const noexcept { return size_; }
    std::uint64_t used_size() const noexcept { return used_; }
    /// The number of parts, free or not. Free neighbors are one part. O(parts).
    std::size_t part_count() const noexcept;

private:
    static unsigned bin_of(std::uint64_t size) noexcept;
    void put_in_bin(Part& part) noexcept;
    void take_from_bin(Part& part) noexcept;
    Part* find(std::uint64_t size, std::uint64_t alignment) const noexcept;
    Part& split(Part& part, std::uint64_t size);
    static void join_above(Part& part) noexcept;

    std::uint64_t size_;
    std::uint64_t used_ = 0;
    std::unique_ptr<Part> first_;
    std::array<Part*, 64> bins_{};
};

}  // namespace rimline
