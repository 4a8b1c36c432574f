#pragma once

// Where the program keeps what it can compute again.

#include <filesystem>

namespace rimline::tools {

/// The folder "rimline" in the user's folder for caches: $XDG_CACHE_HOME, or .cache in $HOME. Empty where the
/// environment names neither. It need not exist.
std::filesystem::path user_cache_folder();

}  // namespace rimline::tools
