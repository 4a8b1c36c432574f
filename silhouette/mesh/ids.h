#pragma once

// Index types that do not convert to each other. An id is an index into an array of a Mesh, and
// `index(id)` is its number.

#include <cstdint>

namespace rimline {

enum class VertexId : std::uint32_t {};
enum class FaceId : std::uint32_t {};
enum class EdgeId : std::uint32_t {};
enum class MaterialId : std::uint32_t {};
enum class TextureId : std::uint32_t {};

constexpr FaceId k_no_face{0xffffffffu};
constexpr EdgeId k_no_edge{0xffffffffu};
constexpr MaterialId k_no_material{0xffffffffu};
constexpr TextureId k_no_texture{0xffffffffu};

constexpr std::uint32_t index(VertexId id) noexcept { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(FaceId id) noexcept { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(EdgeId id) noexcept { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(MaterialId id) noexcept { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(TextureId id) noexcept { return static_cast<std::uint32_t>(id); }

}  // namespace rimline
