#pragma once

// Freed memory stays in this process, for the next allocation.
//
// By itself glibc returns large blocks, and what is free at the heap's end, to the system, and touching their
// successors costs a page fault for every 4 KB. lavapipe allocates and frees megabytes for every draw. Whether they
// lie at the heap's end is chance: surfaces of ogre without lines, 428x321 with one sample, took 70 ms a frame, of
// which 50 were page faults (of 12 microseconds, on a virtual machine).

namespace rimline::tools {

/// Keeps blocks of up to 32 MiB, and up to 64 MiB at the heap's end. Does nothing with other C libraries. Call it
/// before the first thread starts.
void keep_freed_memory();

}  // namespace rimline::tools
