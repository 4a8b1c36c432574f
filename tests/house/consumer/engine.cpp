#include <cstdio>

#include "engine/vulkan/device_choice.h"

int main() {
    std::printf("What Rimline asks of a Vulkan device:\n");
    for (const std::string& lack : rimline::judge_device({}).lacks)
        std::printf("  %s\n", lack.c_str());
}
