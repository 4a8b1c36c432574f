#pragma once

// A sort on all threads that can be stopped.

#include <tbb/parallel_sort.h>
#include <tbb/task_group.h>

#include <stop_token>

#include "silhouette/error.h"

namespace rimline {

/// tbb::parallel_sort, which throws Error{cancelled} soon after a stop, in any order of the elements.
template <typename Iterator, typename Less>
void stoppable_sort(Iterator first, Iterator last, const std::stop_token& stop, const Less& less) {
    tbb::task_group_context context;
    tbb::task_group group(context);
    const std::stop_callback cancel(stop, [&] { context.cancel_group_execution(); });
    group.run_and_wait([&] { tbb::parallel_sort(first, last, less); });
    LongCall{stop, {}}.checkpoint(1.0);
}

}  // namespace rimline
