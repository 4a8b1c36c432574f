#pragma once

// Ctrl-C as a stop token.
//
// The first SIGINT or SIGTERM asks long calls to stop, so that destructors run and temporary files go;
// the second one ends the program at once. A signal that was ignored when the program started, as under
// nohup, stays ignored.

#include <stop_token>

namespace rimline::tools {

/// Call it once, before any thread is started: every thread has to inherit the signal mask.
std::stop_token stop_on_interrupt();

/// Ends the program as the signal that stopped it would have, so that a shell's loop stops as well.
/// Does nothing when there was none.
void end_as_interrupted();

}  // namespace rimline::tools
