#pragma once

// The machine and the instruction sets of a measurement.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rimline::tools {

struct BenchMachine {
    std::string cpu;
    std::uint32_t threads;  ///< Of the system. Only builds use more than one.
    std::string tree;       ///< The instruction set of the octree's loops.
    std::string packed;     ///< That of packed brute force; empty in a build without it.
};

BenchMachine this_machine();
/// The instruction set of packed brute force. Empty in a build without the other methods.
std::string packed_instruction_set();
void print_machine(const BenchMachine& machine);
nlohmann::ordered_json to_json(const BenchMachine& machine);

/// The peak memory of this process so far, as the system counts it.
std::uint64_t peak_resident_bytes();
/// The memory that this process holds on the heap now. 0 where the C library does not count it, as with the
/// address sanitizer's.
std::uint64_t heap_bytes();

}  // namespace rimline::tools
