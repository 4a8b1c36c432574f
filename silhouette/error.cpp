#include "silhouette/error.h"

#include <cstdio>
#include <cstdlib>

namespace rimline {

void check_failed(const char* condition, const char* file, int line) noexcept {
    std::fprintf(stderr, "rimline: %s:%d: the caller broke the contract: %s\n", file, line,
                 condition);
    std::abort();
}

}  // namespace rimline
