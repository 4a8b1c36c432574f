#include "tools/bench/machine.h"

#include <malloc.h>
#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "silhouette/hough/hough_octree.h"

namespace rimline::tools {

namespace {

std::string processor_name() {
    std::ifstream cpu_info("/proc/cpuinfo");
    for (std::string line; std::getline(cpu_info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos)
            return line.substr(colon + 2);
    }
    return "unknown";
}

}  // namespace

BenchMachine this_machine() {
    return {processor_name(), std::thread::hardware_concurrency(),
            std::string(HoughOctree::instruction_set())};
}

void print_machine(const BenchMachine& machine) {
    std::printf("%s, %u threads, one of them measured; octree and brute force use %s\n\n",
                machine.cpu.c_str(), machine.threads, machine.instruction_set.c_str());
}

nlohmann::ordered_json to_json(const BenchMachine& machine) {
    return {{"cpu", machine.cpu},
            {"threads", machine.threads},
            {"instruction_set", machine.instruction_set}};
}

std::uint64_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

std::uint64_t heap_bytes() {
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

}  // namespace rimline::tools
