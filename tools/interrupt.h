#pragma once

// Ctrl-C as a stop token.
//
// The first SIGINT or SIGTERM asks long calls to stop, so that destructors run and temporary files go.
// The program is ended all the same by a second one, or when it has not stopped within k_grace_seconds:
// then it computes where nothing asks, or waits for another program. Temporary files go here as well.
// A signal that was ignored when the program started, as under nohup, stays ignored.

#include <stop_token>

namespace rimline::tools {

/// Longer than the longest step between two checkpoints on models of usual size, shorter than what
/// supervisors wait before they kill.
constexpr int k_grace_seconds = 5;

/// Call it once, before any thread is started: every thread has to inherit the signal mask.
std::stop_token stop_on_interrupt();

/// Ends the program as the signal that stopped it would have, so that a shell's loop stops as well.
/// Does nothing when there was none.
void end_as_interrupted();

}  // namespace rimline::tools
