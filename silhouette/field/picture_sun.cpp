#include "silhouette/field/picture_sun.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/mesh/corner_normals.h"
#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/line_hit.h"

namespace rimline {

namespace {

// The middles of the steps of tone() in surface_shading.glsl.
constexpr double k_lit_cosine = 0.155;
constexpr double k_bright_cosine = 0.54;

constexpr std::uint32_t k_picture_rays = 2400;
constexpr std::uint32_t k_key_rays = 800;
constexpr int k_sun_azimuths = 24;
constexpr std::size_t k_first_suns = 2;
constexpr std::size_t k_suns_at_a_time = 16;  // For as many threads.
constexpr std::array<double, 4> k_high_deg{12.0, 25.0, 40.0, 55.0};
constexpr std::array<double, 3> k_low_deg{0.0, -25.0, -50.0};
constexpr double k_below_horizon =
    -0.2;  // Height of `back` over the ground, of a camera that looks up.

// Of lit places: a third to two thirds, by a margin for what a grid of places misses.
constexpr double k_least_lit = 1.0 / 3.0 + 0.03;
constexpr double k_most_lit = 2.0 / 3.0 - 0.03;
constexpr double k_dark_falloff = 0.03, k_light_falloff = 0.09;
constexpr double k_least_usual = 0.5;
constexpr double k_least_spread = 0.05;  // So that the other terms decide on one flat face.

// Of a grid of which fewer rays meet the mesh, the places say too little.
constexpr double k_least_met = 0.01;

constexpr double k_ray_offset_radii = 1e-4;
constexpr double k_same_surface_steps = 4.0;  // Neighbors farther apart are different parts.

constexpr std::size_t k_max_keys = 48;
constexpr double k_key_turn_rad = glm::radians(10.0);
constexpr double k_turn_cost = 0.5;  // Of a radian.

// The rectangle of the picture that the mesh covers, as shares of half its size; empty beside it.
struct CoveredRectangle {
    glm::dvec2 low{1.0}, high{-1.0};
};
CoveredRectangle covered_by(const Mesh& mesh, const PictureFrame& frame) {
    CoveredRectangle covered;
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3 away = glm::dvec3(position) - frame.eye;
        const double depth = frame.is_orthographic ? 1.0 : -glm::dot(away, frame.back);
        if (depth <= 0.0) return {glm::dvec2(-1.0), glm::dvec2(1.0)};
        const glm::dvec2 place = glm::dvec2(glm::dot(away, frame.right), glm::dot(away, frame.up)) /
                                 (depth * frame.half_size);
        covered.low = glm::min(covered.low, place);
        covered.high = glm::max(covered.high, place);
    }
    covered.low = glm::max(covered.low, -1.0);
    covered.high = glm::min(covered.high, 1.0);
    return covered;
}

// In the picture's plane, at distance 1 from the eye. Nothing for a face that reaches beside or behind the eye.
std::optional<std::array<glm::dvec2, 3>> projected(const Mesh& mesh, std::uint32_t face,
                                                   const PictureFrame& frame) {
    std::array<glm::dvec2, 3> corners;
    const std::array<glm::dvec3, 3> positions = corners_of(mesh, face);
    for (std::size_t c = 0; c < 3; ++c) {
        const glm::dvec3 away = positions[c] - frame.eye;
        const double depth = frame.is_orthographic ? 1.0 : -glm::dot(away, frame.back);
        if (!(depth > 0.0)) return std::nullopt;
        corners[c] = glm::dvec2(glm::dot(away, frame.right), glm::dot(away, frame.up)) / depth;
    }
    return corners;
}

// Points of the picture's plane that lie in the pictures of faces, hidden faces too: at most `count`, even by area.
std::vector<glm::dvec2> points_in_faces(const Mesh& mesh, const PictureFrame& frame,
                                        std::uint32_t count) {
    std::vector<std::array<glm::dvec2, 3>> faces;
    std::vector<double> sums;  // Of areas.
    double sum = 0.0;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const std::optional<std::array<glm::dvec2, 3>> corners = projected(mesh, face, frame);
        if (!corners) continue;
        const auto& [a, b, c] = *corners;
        const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        if (low.x > frame.half_size.x || low.y > frame.half_size.y || high.x < -frame.half_size.x ||
            high.y < -frame.half_size.y)
            continue;
        const double area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        if (!(area > 0.0)) continue;
        faces.push_back(*corners);
        sums.push_back(sum += area);
    }
    std::vector<glm::dvec2> points;
    if (faces.empty()) return points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double at = sum * (i + 0.5) / count;
        const auto found = std::ranges::upper_bound(sums, at);
        const std::size_t face = std::min(std::size_t(found - sums.begin()), faces.size() - 1);
        // The sequence R2 of M. Roberts: even in the square, and folded in the triangle.
        double v = std::fmod(0.7548776662466927 * (i + 0.5), 1.0);
        double w = std::fmod(0.5698402909980532 * (i + 0.5), 1.0);
        if (v + w > 1.0) {
            v = 1.0 - v;
            w = 1.0 - w;
        }
        const auto& [a, b, c] = faces[face];
        const glm::dvec2 point = a + v * (b - a) + w * (c - a);
        if (std::abs(point.x) <= frame.half_size.x && std::abs(point.y) <= frame.half_size.y)
            points.push_back(point);
    }
    return points;
}

double lit_share_preference(double lit) {
    const double outside =
        std::max({0.0, (k_least_lit - lit) / k_dark_falloff, (lit - k_most_lit) / k_light_falloff});
    return 1.0 / (1.0 + outside * outside);
}

// Light from above and from the viewer's side, from the left or a little less from the right.
double usual_light_preference(const glm::dvec3& sun, const PictureFrame& frame) {
    constexpr double k_right_share = 0.97;
    const glm::dvec3 middle = frame.up + frame.back;
    const double left = glm::dot(sun, glm::normalize(middle - frame.right));
    const double right = glm::dot(sun, glm::normalize(middle + frame.right));
    return glm::mix(k_least_usual, 1.0, std::max({0.0, left, k_right_share * right}));
}

std::vector<glm::dvec3> candidate_suns(std::span<const PictureFrame> frames,
                                       const PictureSunOptions& options) {
    const glm::dvec3 up = glm::normalize(options.up);
    // Around the axis from the first camera on, so that nothing changes if camera and mesh turn together.
    const PictureFrame& first = frames.front();
    glm::dvec3 level = glm::cross(up, first.back);
    if (glm::length(level) < 1e-3) level = glm::cross(up, first.up);
    const glm::dvec3 right =
        glm::length(level) < 1e-3 ? ground_axes(up).first : glm::normalize(level);
    const glm::dvec3 front = glm::cross(right, up);
    // Over a ground no sun is so low that the shadow is much longer than the mesh is high.
    std::vector<double> elevations(k_high_deg.begin() + (options.has_ground ? 2 : 0),
                                   k_high_deg.end());
    const bool looks_up = std::ranges::any_of(frames, [&](const PictureFrame& frame) {
        return glm::dot(frame.back, up) < k_below_horizon;
    });
    if (looks_up && !options.has_ground)
        elevations.insert(elevations.end(), k_low_deg.begin(), k_low_deg.end());
    std::vector<glm::dvec3> suns;
    for (const double elevation_deg : elevations)
        for (int i = 0; i < k_sun_azimuths; ++i) {
            const double azimuth = 2.0 * std::numbers::pi * i / k_sun_azimuths;
            const double elevation = glm::radians(elevation_deg);
            suns.push_back(std::cos(elevation) *
                               (std::cos(azimuth) * front + std::sin(azimuth) * right) +
                           std::sin(elevation) * up);
        }
    return suns;
}

std::vector<SunTones> tones_of(const SunSurvey& survey, std::span<const SeenPlace> places,
                               std::span<const glm::dvec3> suns) {
    std::vector<SunTones> tones(suns.size());
    tbb::parallel_for(std::size_t{0}, suns.size(),
                      [&](std::size_t i) { tones[i] = survey.tones(places, suns[i]); });
    return tones;
}

double entropy_term(double share) {
    return share > 0.0 ? -share * std::log(share) / std::log(3.0) : 0.0;
}

bool faces_sun(const SeenPlace& place, const glm::dvec3& sun) {
    return glm::dot(place.normal, sun) >= k_lit_cosine && glm::dot(place.face_normal, sun) > 0.0;
}

// What a sun does at places where is_blocked(place) says which of those that face it lie in a cast shadow.
template <typename IsBlocked>
SunTones measure_tones(std::span<const SeenPlace> places, const glm::dvec3& sun,
                       IsBlocked&& is_blocked) {
    SunTones tones;
    double all_detail = 0.0;
    for (const SeenPlace& place : places) {
        all_detail += place.detail;
        if (!faces_sun(place, sun) || is_blocked(place)) continue;
        tones.lit += 1.0;
        tones.detail += place.detail;
        if (glm::dot(place.normal, sun) >= k_bright_cosine) tones.bright += 1.0;
    }
    const double count = std::max(1.0, double(places.size()));
    tones.lit /= count;
    tones.bright /= count;
    // Without any detail, as on one flat face, the lit share.
    tones.detail = all_detail > 1e-9 * count ? tones.detail / all_detail : tones.lit;
    for (const double share : {1.0 - tones.lit, tones.lit - tones.bright, tones.bright})
        tones.spread += entropy_term(share);
    return tones;
}

// No less than the score with cast shadows, which only take: of lit and bright places and of detail there are at most
// as many as without. Dark places are then at least, and bright ones at most, what they are without, which limits the
// entropy where that is on the far side of a third.
double most_score_of(const SunTones& without_shadows, const glm::dvec3& sun,
                     const PictureFrame& frame) {
    const auto most_spread = [](double share) {
        return entropy_term(share) + 2.0 * entropy_term((1.0 - share) / 2.0);
    };
    SunTones most = without_shadows;
    most.spread = std::min(most_spread(std::max(1.0 - most.lit, 1.0 / 3.0)),
                           most_spread(std::min(most.bright, 1.0 / 3.0)));
    most.lit = std::min(most.lit, 0.5);
    return picture_sun_score(most, sun, frame) * (1.0 + 1e-9);
}

// Frames between which the camera turns, the first among them. The last one is one past the frames if the path is
// closed: the first camera again.
struct KeyFrames {
    std::vector<std::size_t> numbers;
    bool is_closed = false;
};
KeyFrames key_frames(std::span<const PictureFrame> frames) {
    KeyFrames keys{{0}, false};
    double total = 0.0, most = 0.0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const double turn = angle_between(frames[i - 1].back, frames[i].back);
        total += turn;
        most = std::max(most, turn);
    }
    keys.is_closed = total > std::numbers::pi &&
                     angle_between(frames.back().back, frames.front().back) < 1.5 * most;
    const double step = std::max(k_key_turn_rad, total / double(k_max_keys - 2));
    double turned = 0.0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        turned += angle_between(frames[i - 1].back, frames[i].back);
        if (turned < step) continue;
        keys.numbers.push_back(i);
        turned = 0.0;
    }
    if (keys.is_closed)
        keys.numbers.push_back(frames.size());
    else if (turned > 0.0)
        keys.numbers.push_back(frames.size() - 1);
    return keys;
}

// The sequence of candidates, one for each key, that costs least.
class SunSequence {
public:
    SunSequence(std::span<const glm::dvec3> suns, std::size_t first)
        : suns_(suns), costs_(suns.size(), std::numeric_limits<double>::infinity()) {
        costs_[first] = 0.0;
    }

    // `scores` has one element for each sun. The sun turns by at most `max_turn`.
    void add_key(std::span<const double> scores, double max_turn) {
        std::vector<std::size_t> from(suns_.size(), 0);
        std::vector<double> costs(suns_.size(), std::numeric_limits<double>::infinity());
        for (std::size_t to = 0; to < suns_.size(); ++to) {
            for (std::size_t i = 0; i < suns_.size(); ++i) {
                const double turn = angle_between(suns_[i], suns_[to]);
                const double cost = costs_[i] + k_turn_cost * turn;
                if (turn > max_turn || cost >= costs[to]) continue;
                costs[to] = cost;
                from[to] = i;
            }
            costs[to] -= std::log(std::max(scores[to], 1e-6));
        }
        costs_ = std::move(costs);
        came_from_.push_back(std::move(from));
    }

    std::size_t best_end() const {
        return static_cast<std::size_t>(std::ranges::min_element(costs_) - costs_.begin());
    }
    bool can_end_at(std::size_t sun) const { return std::isfinite(costs_[sun]); }

    std::vector<std::size_t> ending_at(std::size_t end) const {
        std::vector<std::size_t> sequence(came_from_.size() + 1, end);
        for (std::size_t key = came_from_.size(); key-- > 0;)
            sequence[key] = came_from_[key][sequence[key + 1]];
        return sequence;
    }

private:
    std::span<const glm::dvec3> suns_;
    std::vector<double> costs_;
    std::vector<std::vector<std::size_t>> came_from_;
};

// The mean of the directions within `reach` frames of each one.
std::vector<glm::dvec3> smoothed(const std::vector<glm::dvec3>& suns, std::ptrdiff_t reach,
                                 bool is_closed) {
    const auto count = static_cast<std::ptrdiff_t>(suns.size());
    std::vector<glm::dvec3> result;
    result.reserve(suns.size());
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        glm::dvec3 sum(0.0);
        for (std::ptrdiff_t j = i - reach; j <= i + reach; ++j) {
            const std::ptrdiff_t k =
                is_closed ? (j + count) % count : std::clamp<std::ptrdiff_t>(j, 0, count - 1);
            sum += suns[static_cast<std::size_t>(k)];
        }
        result.push_back(glm::normalize(sum));
    }
    return result;
}

}  // namespace

std::vector<glm::dvec3> picture_sun_candidates(const PictureFrame& frame,
                                               const PictureSunOptions& options) {
    return candidate_suns({&frame, 1}, options);
}

double picture_sun_score(const SunTones& tones, const glm::dvec3& sun, const PictureFrame& frame) {
    return lit_share_preference(tones.lit) * std::max(tones.spread, k_least_spread) * tones.detail *
           usual_light_preference(sun, frame);
}

SunSurvey::SunSurvey(const Mesh& mesh, float crease_angle_rad, const LongCall& call)
    : mesh_(mesh), tree_(mesh, call.part(0.0, 0.7)) {
    call.checkpoint(0.7);
    normals_ = corner_normals(mesh, crease_angle_rad, call.stop);
    call.checkpoint(1.0);
}

std::optional<SeenPlace> SunSurvey::place_at(const PictureFrame& frame,
                                             const glm::dvec2& at) const {
    const double reach = glm::distance(frame.eye, mesh_.center()) + 2.0 * mesh_.radius();
    const glm::dvec3 beside = at.x * frame.right + at.y * frame.up;
    const glm::dvec3 from =
        frame.is_orthographic ? frame.eye + beside + reach * frame.back : frame.eye;
    const glm::dvec3 direction =
        frame.is_orthographic ? -frame.back : glm::normalize(beside - frame.back);
    const double length = frame.is_orthographic ? 2.0 * reach : reach;
    std::optional<LineHit> nearest;
    std::uint32_t seen = 0;
    tree_.each_along(from, from + length * direction, [&](std::uint32_t face) {
        const std::optional<LineHit> hit = meet(corners_of(mesh_, face), from, direction);
        if (!hit || hit->distance <= 0.0) return;
        if (nearest && (hit->distance > nearest->distance ||
                        (hit->distance == nearest->distance && face > seen)))
            return;
        nearest = hit;
        seen = face;
    });
    if (!nearest) return std::nullopt;
    const std::array<glm::dvec3, 3> corners = corners_of(mesh_, seen);
    glm::dvec3 face_normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length_of_normal = glm::length(face_normal);
    if (!(length_of_normal > 0.0)) return std::nullopt;
    const double side = glm::dot(face_normal, direction) > 0.0 ? -1.0 : 1.0;
    const std::array<double, 3> weights{1.0 - nearest->v - nearest->w, nearest->v, nearest->w};
    glm::dvec3 normal(0.0);
    for (std::size_t c = 0; c < 3; ++c)
        normal += weights[c] * glm::dvec3(normals_[3 * std::size_t{seen} + c]);
    face_normal *= side / length_of_normal;
    normal = glm::length(normal) > 0.0 ? side * glm::normalize(normal) : face_normal;
    return SeenPlace{from + nearest->distance * direction, normal, face_normal, seen, 0.0};
}

std::vector<SeenPlace> SunSurvey::places_in_faces(const PictureFrame& frame,
                                                  std::uint32_t rays) const {
    const std::vector<glm::dvec2> points = points_in_faces(mesh_, frame, rays);
    std::vector<std::optional<SeenPlace>> met(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(),
                      [&](std::size_t i) { met[i] = place_at(frame, points[i]); });
    std::vector<SeenPlace> found;
    for (const std::optional<SeenPlace>& place : met)
        if (place) found.push_back(*place);
    return found;
}

std::vector<SeenPlace> SunSurvey::places(const PictureFrame& frame, std::uint32_t rays) const {
    const CoveredRectangle covered = covered_by(mesh_, frame);
    const glm::dvec2 low = covered.low * frame.half_size, high = covered.high * frame.half_size;
    const glm::dvec2 size = high - low;
    if (!(size.x > 0.0 && size.y > 0.0)) return {};
    const double spacing = std::sqrt(size.x * size.y / rays);
    const auto columns = static_cast<std::size_t>(std::clamp(size.x / spacing, 1.0, double(rays)));
    const auto rows =
        static_cast<std::size_t>(std::clamp(size.y / spacing, 1.0, double(rays) / double(columns)));
    std::vector<std::optional<SeenPlace>> grid(columns * rows);
    tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t i) {
        const glm::dvec2 share((double(i % columns) + 0.5) / double(columns),
                               (double(i / columns) + 0.5) / double(rows));
        grid[i] = place_at(frame, glm::mix(low, high, share));
    });
    std::vector<SeenPlace> found;
    const double step =
        frame.is_orthographic ? spacing : spacing * glm::distance(frame.eye, mesh_.center());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (!grid[i]) continue;
        SeenPlace place = *grid[i];
        const auto add_detail = [&](bool is_inside, std::size_t neighbor) {
            if (!is_inside || !grid[neighbor]) return;
            if (glm::distance(grid[neighbor]->position, place.position) <
                k_same_surface_steps * step)
                place.detail += glm::distance(grid[neighbor]->normal, place.normal);
        };
        add_detail(i % columns > 0, i - 1);
        add_detail(i % columns + 1 < columns, i + 1);
        add_detail(i >= columns, i - columns);
        add_detail(i + columns < grid.size(), i + columns);
        found.push_back(place);
    }
    if (double(found.size()) >= k_least_met * double(grid.size())) return found;
    std::vector<SeenPlace> in_faces = places_in_faces(frame, rays);
    return in_faces.size() > found.size() ? in_faces : found;
}

bool SunSurvey::is_blocked(const SeenPlace& place, const glm::dvec3& sun) const {
    const glm::dvec3 from =
        place.position + k_ray_offset_radii * mesh_.radius() * place.face_normal;
    return tree_.any_along(from, from + 2.1 * mesh_.radius() * sun, [&](std::uint32_t face) {
        if (face == place.face) return false;
        const std::optional<LineHit> hit = meet(corners_of(mesh_, face), from, sun);
        return hit && hit->distance > 0.0;
    });
}

SunTones SunSurvey::tones(std::span<const SeenPlace> places, const glm::dvec3& sun) const {
    return measure_tones(places, sun,
                         [&](const SeenPlace& place) { return is_blocked(place, sun); });
}

std::optional<SunTones> SunSurvey::tones(
    std::span<const SeenPlace> places, const glm::dvec3& sun,
    const std::function<bool(const SunTones&)>& is_enough) const {
    SunTones most = measure_tones(places, sun, [](const SeenPlace&) { return false; });
    double all_detail = 0.0;
    for (const SeenPlace& place : places) all_detail += place.detail;
    const double share = 1.0 / double(places.size());
    const bool has_detail = all_detail * share > 1e-9;
    std::vector<std::uint8_t> blocked(places.size(), 0);
    // Places far apart first: what they say of the rest comes sooner.
    constexpr std::size_t k_stride = 8, k_between_questions = 32;
    std::size_t count = 0;
    for (std::size_t first = 0; first < k_stride; ++first)
        for (std::size_t i = first; i < places.size(); i += k_stride) {
            const SeenPlace& place = places[i];
            if (!faces_sun(place, sun)) continue;
            if (is_blocked(place, sun)) {
                blocked[i] = 1;
                most.lit -= share;
                most.detail -= has_detail ? place.detail / all_detail : share;
                if (glm::dot(place.normal, sun) >= k_bright_cosine) most.bright -= share;
            }
            if (++count % k_between_questions == 0 && is_enough(most)) return std::nullopt;
        }
    return measure_tones(places, sun, [&](const SeenPlace& place) {
        return blocked[static_cast<std::size_t>(&place - places.data())] != 0;
    });
}

std::optional<PictureSun> choose_picture_sun(const SunSurvey& survey, const PictureFrame& frame,
                                             const PictureSunOptions& options,
                                             const LongCall& call) {
    const std::vector<SeenPlace> places = survey.places(frame, k_picture_rays);
    if (places.empty()) return std::nullopt;
    call.checkpoint(0.2);
    struct Candidate {
        double most;
        std::size_t number;
        glm::dvec3 sun;
    };
    std::vector<Candidate> candidates;
    for (const glm::dvec3& sun : picture_sun_candidates(frame, options)) {
        const SunTones tones = measure_tones(places, sun, [](const SeenPlace&) { return false; });
        candidates.push_back({most_score_of(tones, sun, frame), candidates.size(), sun});
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.most != b.most ? a.most > b.most : a.number < b.number;
    });
    // Some at a time for all threads, until no other can be better. The first few find what the others have to reach.
    std::vector<std::optional<SunTones>> tones;
    PictureSun best{{}, {}, -1.0};
    std::size_t best_number = 0;
    for (std::size_t first = 0, count = k_first_suns; first < candidates.size();
         first += tones.size()) {
        if (candidates[first].most < best.score) break;
        call.checkpoint(0.2 + 0.8 * double(first) / double(candidates.size()));
        tones.assign(std::min(count, candidates.size() - first), std::nullopt);
        tbb::parallel_for(std::size_t{0}, tones.size(), [&](std::size_t i) {
            const glm::dvec3& sun = candidates[first + i].sun;
            tones[i] = survey.tones(places, sun, [&](const SunTones& most) {
                return most_score_of(most, sun, frame) < best.score;
            });
        });
        for (std::size_t i = 0; i < tones.size(); ++i) {
            if (!tones[i]) continue;
            const auto& [most, number, sun] = candidates[first + i];
            const double score = picture_sun_score(*tones[i], sun, frame);
            if (score < best.score || (score == best.score && number > best_number)) continue;
            best = {sun, *tones[i], score};
            best_number = number;
        }
        count = std::min(2 * count, k_suns_at_a_time);
    }
    call.checkpoint(1.0);
    return best;
}

std::vector<glm::dvec3> choose_moving_sun(const SunSurvey& survey,
                                          std::span<const PictureFrame> frames,
                                          const PictureSunOptions& options, const LongCall& call) {
    if (frames.empty()) return {};
    const KeyFrames keys = key_frames(frames);
    const std::vector<glm::dvec3> suns = candidate_suns(frames, options);
    const auto scores_at = [&](const PictureFrame& frame) {
        std::vector<double> scores(suns.size(), 1.0);  // Where nothing is seen, any sun will do.
        const std::vector<SeenPlace> places = survey.places(frame, k_key_rays);
        if (places.empty()) return scores;
        const std::vector<SunTones> tones = tones_of(survey, places, suns);
        for (std::size_t i = 0; i < suns.size(); ++i)
            scores[i] = picture_sun_score(tones[i], suns[i], frame);
        return scores;
    };
    const std::vector<double> first_scores = scores_at(frames.front());
    const auto first =
        static_cast<std::size_t>(std::ranges::max_element(first_scores) - first_scores.begin());
    SunSequence sequence(suns, first);
    const double step = 2.0 * std::numbers::pi / k_sun_azimuths;
    for (std::size_t k = 1; k < keys.numbers.size(); ++k) {
        call.checkpoint(double(k) / double(keys.numbers.size()));
        const PictureFrame& before = frames[keys.numbers[k - 1]];
        const bool is_first_again = keys.numbers[k] == frames.size();
        const PictureFrame& frame = is_first_again ? frames.front() : frames[keys.numbers[k]];
        const double turn = angle_between(before.back, frame.back);
        sequence.add_key(is_first_again ? first_scores : scores_at(frame),
                         std::max(2.0 * turn, 1.1 * step));
    }
    const bool is_closed = keys.is_closed && sequence.can_end_at(first);
    const std::vector<std::size_t> chosen =
        sequence.ending_at(is_closed ? first : sequence.best_end());
    std::vector<glm::dvec3> moving;
    moving.reserve(frames.size());
    std::size_t key = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        while (key + 1 < keys.numbers.size() && keys.numbers[key + 1] <= i) ++key;
        const std::size_t next = std::min(key + 1, keys.numbers.size() - 1);
        const double length = double(keys.numbers[next]) - double(keys.numbers[key]);
        const double share = length > 0.0 ? (double(i) - double(keys.numbers[key])) / length : 0.0;
        moving.push_back(
            glm::normalize(glm::mix(suns[chosen[key]], suns[chosen[next]], std::min(share, 1.0))));
    }
    const auto reach =
        static_cast<std::ptrdiff_t>(frames.size() / std::max<std::size_t>(1, keys.numbers.size()));
    if (keys.numbers.size() < 2) return moving;
    return smoothed(smoothed(moving, reach, is_closed), reach, is_closed);
}

}  // namespace rimline
