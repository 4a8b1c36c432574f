#include "tools/track_path.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <string_view>
#include <system_error>

#include "silhouette/hough/orbit.h"
#include "tools/command.h"

namespace rimline::tools {

namespace {

// The standard's distributions differ between libraries; its generators do not.
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

HomogeneousPoint parse_line(std::string_view line, const std::string& place) {
    const auto fail = [&](const std::string& what) -> Error {
        return {ErrorCode::bad_input, place + ": " + what};
    };
    std::array<double, 4> numbers{0.0, 0.0, 0.0, 1.0};
    std::size_t count = 0;
    constexpr std::string_view k_blank = " \t";
    for (std::size_t at = line.find_first_not_of(k_blank); at != std::string_view::npos;
         at = line.find_first_not_of(k_blank, at)) {
        const std::size_t past = std::min(line.find_first_of(k_blank, at), line.size());
        const std::string_view word = line.substr(at, past - at);
        at = past;
        if (count == numbers.size()) throw fail("expected x y z or x y z w, found more");
        double& number = numbers[count++];
        const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
        if (parsed.ec != std::errc() || parsed.ptr != word.data() + word.size() ||
            !std::isfinite(number))
            throw fail("'" + std::string(word) + "' is not a finite number");
    }
    if (count < 3)
        throw fail("expected x y z or x y z w, found " + std::to_string(count) + " numbers");
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(numbers[i]) > double{k_max_coordinate})
            throw fail("a coordinate is beyond 2^60, about 1.15e18");
    const glm::vec3 xyz(numbers[0], numbers[1], numbers[2]);
    if (numbers[3] == 1.0) return HomogeneousPoint::viewpoint(xyz);
    if (numbers[3] != 0.0) throw fail("w must be 1, a viewpoint, or 0, a direction");
    const HomogeneousPoint direction = HomogeneousPoint::direction(xyz);
    if (is_zero(direction)) throw fail("a direction must not be zero");
    return direction;
}

}  // namespace

std::vector<HomogeneousPoint> orbit_path(const Mesh& mesh, glm::vec3 up, double radius,
                                         double step_degrees, std::uint32_t frames) {
    const double distance = radius * mesh.radius();
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(mesh.center()[axis]) + distance > double{k_max_coordinate})
            throw UsageError("--radius: the orbit leaves the range of coordinates, 2^60");
    const Orbit orbit(mesh.center(), up, distance);
    std::vector<HomogeneousPoint> points;
    points.reserve(frames);
    for (std::uint32_t i = 0; i < frames; ++i)
        points.push_back(orbit.viewpoint(i * step_degrees * std::numbers::pi / 180.0));
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
            case 8: break;  // Stands still.
            default: at += r * std::pow(10.0, random.in(-6.0, -1.0)) * random.in_cube();
        }
        points.push_back(viewpoint_in_range(at));
    }
    return points;
}

std::vector<HomogeneousPoint> read_path(const std::string& file_name) {
    errno = 0;
    std::ifstream file(file_name);
    const auto fail = [&](const std::string& what) {
        return Error(ErrorCode::io,
                     file_name + ": cannot read: " +
                         (errno != 0 ? std::generic_category().message(errno) : what));
    };
    if (!file) throw fail("it does not open");
    std::vector<HomogeneousPoint> points;
    std::uint64_t number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.find_first_not_of(" \t") == std::string::npos || line[0] == '#') continue;
        points.push_back(parse_line(line, file_name + ":" + std::to_string(number)));
    }
    if (file.bad()) throw fail("reading stopped before the end");
    if (points.empty())
        throw Error(ErrorCode::bad_input, file_name + ": it holds no points; write x y z lines");
    return points;
}

}  // namespace rimline::tools
