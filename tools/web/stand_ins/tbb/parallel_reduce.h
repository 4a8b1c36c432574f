#pragma once

// A stand-in for oneTBB (blocked_range.h).

#include <tbb/blocked_range.h>

namespace tbb {

template <typename Index, typename Value, typename Body, typename Join>
Value parallel_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body,
                      const Join&) {
    return range.empty() ? identity : body(range, identity);
}

}  // namespace tbb
