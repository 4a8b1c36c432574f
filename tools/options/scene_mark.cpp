#include "tools/options/scene_mark.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

namespace rimline::tools {

bool is_scene_file(const std::string& model) {
    constexpr std::string_view k_ending = ".json";
    return model.size() > k_ending.size() &&
           std::ranges::equal(std::string_view(model).substr(model.size() - k_ending.size()),
                              k_ending, {},
                              [](char c) { return std::tolower(static_cast<unsigned char>(c)); });
}

bool holds_scene(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
    return json.is_object() && json.contains(k_scene_key);
}

}  // namespace rimline::tools
