#include "tools/options/track_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <new>
#include <numbers>
#include <random>
#include <string_view>

#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "tools/command.h"

namespace rimline::tools {

namespace {

// Distributions of the C++ standard differ between libraries; its generators do not.
class Random {
public:
    explicit Random(std::uint32_t seed) : generator_(seed) {}
    double in(double low, double high) {
        return low + (high - low) * static_cast<double>(generator_()) / 0x1p32;
    }
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>(std::uint64_t{generator_()} * count >> 32);
    }
    glm::dvec3 in_cube() {
        const double x = in(-1.0, 1.0);
        const double y = in(-1.0, 1.0);
        return {x, y, in(-1.0, 1.0)};
    }

private:
    std::mt19937 generator_;
};

HomogeneousPoint viewpoint_in_range(const glm::dvec3& p) {
    const double limit{k_max_coordinate};
    return HomogeneousPoint::viewpoint(glm::vec3(glm::clamp(p, -limit, limit)));
}

bool is_zero(const HomogeneousPoint& point) { return point.xyz() == glm::vec3(0.0f); }

// Parses the scanner's present line: numbers separated by blanks, a comma or both.
HomogeneousPoint parse_line(TextScanner& scanner) {
    constexpr std::array<const char*, 4> k_names{"x", "y", "z", "w"};
    std::array<float, 4> numbers{0.0f, 0.0f, 0.0f, 1.0f};
    std::size_t count = 0;
    bool after_comma = false;
    for (std::string_view token = scanner.token(); !token.empty(); token = scanner.token()) {
        while (!token.empty()) {
            if (token[0] == ',') {
                if (count == 0 || after_comma) scanner.fail("a comma stands where a number should");
                after_comma = true;
                token.remove_prefix(1);
                continue;
            }
            if (count == numbers.size()) scanner.fail("expected x y z or x y z w, found more");
            const std::size_t past = std::min(token.find(','), token.size());
            numbers[count] = scanner.coordinate(token.substr(0, past), k_names[count]);
            ++count;
            after_comma = false;
            token.remove_prefix(past);
        }
    }
    if (after_comma) scanner.fail("the line ends with a comma; a number should follow it");
    if (count < 3)
        scanner.fail("expected x y z or x y z w, found " + std::to_string(count) +
                     (count == 1 ? " number" : " numbers"));
    const glm::vec3 xyz(numbers[0], numbers[1], numbers[2]);
    if (numbers[3] == 1.0f) return HomogeneousPoint::viewpoint(xyz);
    if (numbers[3] != 0.0f) scanner.fail("w must be 1, a viewpoint, or 0, a direction");
    const HomogeneousPoint direction = HomogeneousPoint::direction(xyz);
    if (is_zero(direction)) scanner.fail("a direction must not be zero");
    return direction;
}

}  // namespace

std::vector<HomogeneousPoint> orbit_path(const Mesh& mesh, glm::vec3 up, double radius,
                                         double step_degrees, std::uint32_t frames,
                                         double start_rad) {
    const double distance = radius * mesh.radius();
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(mesh.center()[axis]) + distance > double{k_max_coordinate})
            throw UsageError("--radius: the orbit leaves the range of coordinates, 2^60");
    const Orbit orbit(mesh.center(), up, distance);
    std::vector<HomogeneousPoint> points;
    points.reserve(frames);
    for (std::uint32_t i = 0; i < frames; ++i)
        points.push_back(orbit.viewpoint(start_rad + i * step_degrees * std::numbers::pi / 180.0));
    return points;
}

std::vector<HomogeneousPoint> random_path(const Mesh& mesh, std::uint32_t seed,
                                          std::uint32_t frames) {
    Random random(seed);
    const double r = mesh.radius();
    const glm::dvec3 center = mesh.center();
    std::vector<HomogeneousPoint> points;
    points.reserve(frames);
    glm::dvec3 at = center + 3.0 * r * random.in_cube();
    while (points.size() < frames) {
        switch (random.below(16)) {
            case 0:
            case 1: at = center + 3.0 * r * random.in_cube(); break;
            case 2: at = glm::dvec3(mesh.positions()[random.below(mesh.vertex_count())]); break;
            case 3: at = center; break;
            case 4: at = center + 1e6 * r * random.in_cube(); break;
            case 5:
                if (!points.empty()) {
                    points.push_back(
                        points[random.below(static_cast<std::uint32_t>(points.size()))]);
                    continue;
                }
                break;
            case 6:
            case 7: {
                const HomogeneousPoint direction =
                    HomogeneousPoint::direction(glm::vec3(random.in_cube()));
                if (is_zero(direction)) break;
                points.push_back(direction);
                continue;
            }
            case 8: break;  // No motion.
            default: at += r * std::pow(10.0, random.in(-6.0, -1.0)) * random.in_cube();
        }
        points.push_back(viewpoint_in_range(at));
    }
    return points;
}

std::vector<HomogeneousPoint> read_path(const std::string& file_name, const LongCall& call) {
    try {
        SourceFile file = read_source_file(file_name, call);
        // Skip a byte order mark.
        if (file.bytes.starts_with("\xef\xbb\xbf")) file.bytes.erase(0, 3);
        TextScanner scanner(file.name, file.bytes, {.comment = '#'});
        std::vector<HomogeneousPoint> points;
        while (scanner.next_line()) {
            if (points.size() % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
            points.push_back(parse_line(scanner));
        }
        if (points.empty()) bad_file(file.name, "it holds no points; write lines of x y z");
        return points;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::too_large, file_name + ": there is not enough memory to read it");
    }
}

}  // namespace rimline::tools
