#pragma once

// A stand-in for oneTBB (blocked_range.h).

#include <tbb/blocked_range.h>

namespace tbb {

template <typename Index, typename Body>
void parallel_for(const blocked_range<Index>& range, const Body& body) {
    if (!range.empty()) body(range);
}

template <typename Index, typename Body>
void parallel_for(Index first, Index last, const Body& body) {
    for (Index i = first; i < last; ++i) body(i);
}

}  // namespace tbb
