#include "tools/process/standard_descriptors.h"

#include <fcntl.h>
#include <unistd.h>

namespace rimline::tools {

void open_missing_standard_descriptors() noexcept {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
        if (fcntl(descriptor, F_GETFD) >= 0) continue;
        // In the direction in which it is not used. The system gives the lowest number that is free, which is this.
        open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

}  // namespace rimline::tools
