#pragma once

// A stand-in for oneTBB (blocked_range.h).

namespace tbb {

inline bool is_current_task_group_canceling() { return false; }

}  // namespace tbb
