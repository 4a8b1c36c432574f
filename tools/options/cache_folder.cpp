#include "tools/options/cache_folder.h"

#include <cstdlib>

namespace rimline::tools {

std::filesystem::path user_cache_folder() {
    // A relative path is no answer, by the XDG base directory specification.
    const auto folder_of = [](const char* variable) {
        const char* value = std::getenv(variable);
        const std::filesystem::path path = value ? value : "";
        return path.is_absolute() ? path : std::filesystem::path();
    };
    if (const auto caches = folder_of("XDG_CACHE_HOME"); !caches.empty()) return caches / "rimline";
    if (const auto home = folder_of("HOME"); !home.empty()) return home / ".cache" / "rimline";
    return {};
}

}  // namespace rimline::tools
