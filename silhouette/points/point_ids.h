#pragma once

// Index types of point sets, as silhouette/mesh/ids.h has them for meshes.

#include <cstdint>

namespace rimline {

enum class PointId : std::uint32_t {};
enum class UmbrellaId : std::uint32_t {};

constexpr std::uint32_t index(PointId id) noexcept { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(UmbrellaId id) noexcept { return static_cast<std::uint32_t>(id); }

}  // namespace rimline
