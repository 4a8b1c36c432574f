#pragma once

// Files that a test writes, in a folder of their own that vanishes with it; and ways to read them.

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline::tests {

class ScratchFolder {
public:
    ScratchFolder() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("rimline-formats-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        std::ofstream stream(path_ / name, std::ios::binary);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        REQUIRE(stream.good());
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

/// What a file of that name and content gives.
inline MeshSource read_text(const std::string& name, std::string_view bytes,
                            FaceRequirement requirement = FaceRequirement::faces) {
    const ScratchFolder folder;
    return read_mesh_file(folder.write(name, bytes), requirement);
}

/// The message of the error it gives, without the folder; empty if it gives none.
inline std::string error_of(const std::string& name, std::string_view bytes,
                            FaceRequirement requirement = FaceRequirement::faces_or_points) {
    const ScratchFolder folder;
    const std::filesystem::path path = folder.write(name, bytes);
    try {
        read_mesh_file(path, requirement);
    } catch (const Error& e) {
        const std::string message = e.what();
        const std::string begin = path.string() + ":";
        REQUIRE(message.substr(0, begin.size()) == begin);
        return message.substr(folder.path().string().size() + 1);
    }
    return {};
}

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// What every MeshSource promises.
inline bool is_sound(const MeshSource& source) {
    for (const glm::vec3& p : source.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(p[axis]) <= k_max_coordinate)) return false;
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= source.positions.size()) return false;
    const auto is_color = [](const glm::vec3& color) {
        return std::min({color.x, color.y, color.z}) >= 0.0f &&
               std::max({color.x, color.y, color.z}) <= 1.0f;
    };
    const FaceMaterials& materials = source.materials;
    return are_materials_of(materials, source.triangles.size()) &&
           std::ranges::all_of(materials.materials, is_color, &SurfaceMaterial::base_color) &&
           std::ranges::all_of(materials.corner_colors, is_color);
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

}  // namespace rimline::tests
