#pragma once

// Where tests find real models: the folders of RIMLINE_MODELS, separated by colons.

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

namespace rimline::tests {

/// The first folder's file of that name, or nothing.
inline std::optional<std::filesystem::path> find_model(const std::string& file_name) {
    const char* folders = std::getenv("RIMLINE_MODELS");
    std::istringstream stream(folders ? folders : "");
    for (std::string folder; std::getline(stream, folder, ':');) {
        const std::filesystem::path path = std::filesystem::path(folder) / file_name;
        if (!folder.empty() && std::filesystem::exists(path)) return path;
    }
    return std::nullopt;
}

}  // namespace rimline::tests
