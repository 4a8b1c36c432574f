#include "tools/output/summary_stream.h"

#include <unistd.h>

#include <cstdio>

namespace rimline::tools {

namespace {

bool g_is_dropped = false;

// The stream lives as long as the program.
void replace_standard_output(std::FILE* stream) {
    std::fflush(stdout);
    if (stream != nullptr) stdout = stream;
}

}  // namespace

void drop_summary() {
    replace_standard_output(std::fopen("/dev/null", "w"));
    g_is_dropped = true;
}

void move_summary_to_standard_error() {
    if (g_is_dropped) return;
    const int copy = dup(STDERR_FILENO);
    replace_standard_output(copy < 0 ? nullptr : fdopen(copy, "w"));
}

}  // namespace rimline::tools
