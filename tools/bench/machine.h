#pragma once

// The machine and the instruction sets of a measurement.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rimline::tools {

struct BenchMachine {
    std::string cpu;
    std::uint32_t threads;        ///< Of the system. Only builds use more than one.
    std::string instruction_set;  ///< Of the loops of the octree and of brute force.
};

BenchMachine this_machine();
void print_machine(const BenchMachine& machine);
nlohmann::ordered_json to_json(const BenchMachine& machine);

/// The peak memory of this process so far, as the system counts it.
std::uint64_t peak_resident_bytes();
/// The memory that this process holds on the heap now. 0 where the C library does not count it, as with the
/// address sanitizer's.
std::uint64_t heap_bytes();

}  // namespace rimline::tools
