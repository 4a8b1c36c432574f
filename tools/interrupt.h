#pragma once

// Ctrl-C as a stop token.
//
// The first SIGINT or SIGTERM asks long calls to stop, so that destructors run and remove temporary files.
// A second signal ends the program at once. So does a program that has not stopped within k_grace_seconds,
// because it computes without checkpoints or waits for another program. A signal that was ignored when the
// program started, as under nohup, stays ignored.

#include <stop_token>

namespace rimline::tools {

/// Longer than the longest step between two checkpoints on models of usual size, shorter than the time that
/// supervisors wait before they kill a program.
constexpr int k_grace_seconds = 5;

/// Call it once, before any thread is started: every thread must inherit the signal mask. `clean_up` is
/// called on another thread, while the others still run, before the program is ended without its
/// destructors.
std::stop_token stop_on_interrupt(void (*clean_up)() noexcept);

/// Ends the program by the signal that stopped it, so that a shell's loop stops as well. Does nothing when no
/// signal arrived.
void end_as_interrupted();

}  // namespace rimline::tools
