#include "tools/process/end_with_parent.h"

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdlib>

namespace rimline::tools {

void end_with_parent() {
    const char* parent = std::getenv(k_parent_variable);
    if (parent == nullptr) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (std::atol(parent) != getppid()) std::_Exit(128 + SIGTERM);
}

}  // namespace rimline::tools
