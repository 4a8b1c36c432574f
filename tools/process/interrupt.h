#pragma once

// Signals that end the program, as a stop token.
//
// The first of them asks long calls to stop, so that destructors run and remove temporary files. A program that
// has not stopped within k_grace, because it computes without checkpoints or waits for another program, is ended
// then; leftovers (tools/output/leftover.h) are removed first. A signal that was ignored when the program started,
// as under nohup, stays ignored.
//
// SIGPIPE and SIGXFSZ that the system sends for a write of this program do not stop it: the write fails, and its
// error names the file.

#include <chrono>
#include <stop_token>

namespace rimline::tools {

/// Who presses Ctrl-C sees the program end within 200 ms. The system needs its share to free a gigabyte.
constexpr std::chrono::milliseconds k_grace{100};

/// For SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ and SIGXCPU. Call it once, before any thread is
/// started: every thread must inherit the signal mask. `clean_up` is called on another thread, while the others
/// still run, before the program is ended without its destructors. Where the system starts no more threads,
/// signals end the program at once, and the token is never stopped.
std::stop_token stop_on_interrupt(void (*clean_up)() noexcept);

/// Prints that the program was cancelled, unless it ends without words, and ends it by the signal that stopped it, so
/// that a shell's loop stops as well. Does nothing when no signal arrived.
void end_as_interrupted();

/// From now on the program prints nothing when a signal ends it: for one that works until it is ended.
void end_without_words() noexcept;

/// Ends the program by SIGPIPE or SIGXFSZ if a write of this thread raised it. Does nothing when none did.
void end_as_write_failed();

}  // namespace rimline::tools
