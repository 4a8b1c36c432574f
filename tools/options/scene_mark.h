#pragma once

// What marks a scene file (scene_file.h): its name, and a key of its object.

#include <string>

namespace rimline::tools {

constexpr const char* k_scene_key = "rimline_scene";

/// Whether MODEL names a scene file: it ends in .json.
bool is_scene_file(const std::string& model);

/// Whether the file is a JSON object with the key of a scene. Reads all of it; false if it cannot be read.
bool holds_scene(const std::string& path);

}  // namespace rimline::tools
