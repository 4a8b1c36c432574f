#pragma once

// What a measurement was made on and with.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rimline::tools {

struct BenchMachine {
    std::string cpu;
    std::uint32_t threads;  ///< That the system offers; only builds use more than one.
    std::string tree;       ///< What the octree's loops were compiled for.
    std::string packed;     ///< The same of packed brute force; empty in a build without it.
};

BenchMachine this_machine();
/// What the loops of packed brute force were compiled for. Empty in a build without the other methods.
std::string packed_instruction_set();
void print_machine(const BenchMachine& machine);
nlohmann::ordered_json to_json(const BenchMachine& machine);

/// The most memory that this process has held so far, by the system's count.
std::uint64_t peak_resident_bytes();

}  // namespace rimline::tools
