#include "engine/vulkan/range_allocator.h"

#include <bit>
#include <utility>

#include "engine/vulkan/rounding.h"
#include "silhouette/error.h"

namespace rimline {

RangeAllocator::RangeAllocator(std::uint64_t size) : size_(size), first_(new Part) {
    RIMLINE_CHECK(size > 0);
    first_->size_ = size;
    put_in_bin(*first_);
}

// One after the other: a chain of destructors could be too deep.
RangeAllocator::~RangeAllocator() {
    while (first_) first_ = std::move(first_->above_);
}

std::size_t RangeAllocator::part_count() const noexcept {
    std::size_t count = 0;
    for (const Part* part = first_.get(); part; part = part->above_.get()) ++count;
    return count;
}

unsigned RangeAllocator::bin_of(std::uint64_t size) noexcept {
    return static_cast<unsigned>(std::bit_width(size)) - 1;
}

void RangeAllocator::put_in_bin(Part& part) noexcept {
    Part*& first = bins_[bin_of(part.size_)];
    part.is_free_ = true;
    part.previous_ = nullptr;
    part.next_ = first;
    if (first) first->previous_ = &part;
    first = &part;
}

void RangeAllocator::take_from_bin(Part& part) noexcept {
    if (part.previous_)
        part.previous_->next_ = part.next_;
    else
        bins_[bin_of(part.size_)] = part.next_;
    if (part.next_) part.next_->previous_ = part.previous_;
    part.is_free_ = false;
}

RangeAllocator::Part* RangeAllocator::find(std::uint64_t size,
                                           std::uint64_t alignment) const noexcept {
    for (unsigned bin = bin_of(size); bin < bins_.size(); ++bin)
        for (Part* part = bins_[bin]; part; part = part->next_) {
            const std::uint64_t padding = rounded_up(part->offset_, alignment) - part->offset_;
            if (padding <= part->size_ && size <= part->size_ - padding) return part;
        }
    return nullptr;
}

// Cuts `part`, which is in no bin, after `size`, and returns the rest, which is in no bin either. Throws before
// anything has changed.
RangeAllocator::Part& RangeAllocator::split(Part& part, std::uint64_t size) {
    auto rest = std::make_unique<Part>();
    rest->offset_ = part.offset_ + size;
    rest->size_ = part.size_ - size;
    rest->below_ = &part;
    rest->above_ = std::move(part.above_);
    if (rest->above_) rest->above_->below_ = rest.get();
    part.size_ = size;
    part.above_ = std::move(rest);
    return *part.above_;
}

// Both are in no bin.
void RangeAllocator::join_above(Part& part) noexcept {
    const std::unique_ptr<Part> above = std::move(part.above_);
    part.size_ += above->size_;
    part.above_ = std::move(above->above_);
    if (part.above_) part.above_->below_ = &part;
}

RangeAllocator::Part* RangeAllocator::allocate(std::uint64_t size, std::uint64_t alignment) {
    Part* part = find(size, alignment);
    if (!part) return nullptr;
    take_from_bin(*part);
    used_ += part->size_;
    try {
        if (const auto padding = rounded_up(part->offset_, alignment) - part->offset_) {
            Part& aligned = split(*part, padding);
            used_ -= padding;
            put_in_bin(*part);
            part = &aligned;
        }
        if (part->size_ > size) {
            Part& rest = split(*part, size);
            used_ -= rest.size_;
            put_in_bin(rest);
        }
    } catch (...) {
        free(*part);
        throw;
    }
    return part;
}

void RangeAllocator::free(Part& given) noexcept {
    Part* part = &given;
    used_ -= part->size_;
    if (part->above_ && part->above_->is_free_) {
        take_from_bin(*part->above_);
        join_above(*part);
    }
    if (part->below_ && part->below_->is_free_) {
        part = part->below_;
        take_from_bin(*part);
        join_above(*part);
    }
    put_in_bin(*part);
}

}  // namespace rimline
