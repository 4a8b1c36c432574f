#include "silhouette/mesh/formats/point_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <utility>

#include "silhouette/is_finite.h"
#include "silhouette/mesh/formats/file_format.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

PointSource read_points(const KnownFile& known, BadPoints bad, const LongCall& call) {
    PointRecords records;
    switch (known.format) {
        case FileFormat::ply: records = read_ply_points(known.file, bad, call); break;
        case FileFormat::obj: records = read_obj_points(known.file, bad, call); break;
        case FileFormat::point_text: records = read_point_text(known.file, bad, call); break;
        default: records.source = points_of(read_mesh(known, bad, call));
    }
    PointSource& source = records.source;
    // Faces are useless as a reference if a position is not finite.
    if (!std::ranges::all_of(source.positions, is_finite<double>))
        source.triangles.clear();
    else if (records.has_faces)
        source.triangles = read_mesh(known, bad, {call.stop, {}}).triangles;
    return std::move(source);
}

PointSource checked_points(const KnownFile& known, BadPoints bad, const LongCall& call) {
    PointSource source = read_points(known, bad, call);
    if (source.positions.empty()) bad_file(known.file.name, "no points: there is nothing in it");
    call.checkpoint(1.0);
    return source;
}

}  // namespace

std::string refusal(std::uint64_t number, const glm::dvec3& position, BadPoints bad) {
    const double largest =
        std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    if (is_finite(position) && largest <= static_cast<double>(k_max_coordinate)) return {};
    if (!is_finite(position) && bad == BadPoints::keep) return {};
    char text[128];
    std::snprintf(text, sizeof text, " is %.9g %.9g %.9g", position.x, position.y, position.z);
    return "point " + std::to_string(number) + text +
           (is_finite(position)
                ? ", beyond 2^60 in size: scale the cloud down, or take out points without a value"
                : "; only finite points can be used (rimline points --drop-bad leaves out others)");
}

std::uint8_t color_byte(float value) noexcept {
    return value > 0.0f ? static_cast<std::uint8_t>(std::min(value, 255.0f) + 0.5f)
                        : std::uint8_t{0};
}

std::vector<PointColor> point_colors(const std::vector<glm::vec3>& numbers) {
    float largest = 0.0f;
    for (const glm::vec3& c : numbers)
        for (int i = 0; i < 3; ++i)
            if (c[i] > largest) largest = c[i];
    const float scale = largest > 1.0f ? 1.0f : 255.0f;
    std::vector<PointColor> colors(numbers.size());
    for (std::size_t p = 0; p < numbers.size(); ++p)
        for (int i = 0; i < 3; ++i) colors[p][i] = color_byte(numbers[p][i] * scale);
    return colors;
}

PointSource read_point_file(const std::filesystem::path& path, BadPoints bad,
                            const LongCall& call) {
    try {
        call.checkpoint(0.0);
        return checked_points(KnownFile(path, call), bad, call);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::too_large,
                    path.string() + ": there is not enough memory to read it");
    }
}

PointSource read_point_bytes(std::string name, std::string bytes, const std::string& extension,
                             BadPoints bad, const LongCall& call) {
    try {
        call.checkpoint(0.0);
        return checked_points(known_bytes(name, std::move(bytes), extension), bad, call);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::too_large, name + ": there is not enough memory to read it");
    }
}

}  // namespace rimline
