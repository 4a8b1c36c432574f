#include "tools/output/hidden_points.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>

#include "silhouette/error.h"

namespace rimline::tools {

namespace {

// The state of Qhull. It holds pointers into itself, so it cannot be moved.
class Hull {
public:
    Hull() : messages_(std::fopen("/dev/null", "w")) {
        if (!messages_) throw Error(ErrorCode::io, "/dev/null: cannot open it");
        qh_zero(&state_, messages_.get());
    }
    ~Hull() {
        qh_freeqhull(&state_, qh_ALL);
        int rest = 0, blocks = 0;
        qh_memfreeshort(&state_, &rest, &blocks);
    }
    Hull(const Hull&) = delete;
    Hull& operator=(const Hull&) = delete;

    // The indices of the points on the hull, in ascending order. Empty if the points span no volume.
    std::vector<std::uint32_t> vertices(std::vector<glm::dvec3>& points) {
        char command[] = "qhull Qt Pp";
        const int status = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), &points[0].x,
                                        False, command, nullptr, messages_.get());
        if (status == qh_ERRsingular || status == qh_ERRinput) return {};
        if (status != qh_ERRnone)
            throw Error(ErrorCode::too_large, "qhull finds no hull of the points (status " +
                                                  std::to_string(status) + ")");
        std::vector<std::uint32_t> numbers;
        qhT* qh = &state_;  // The macros of Qhull require this name.
        vertexT* vertex = nullptr;
        FORALLvertices numbers.push_back(static_cast<std::uint32_t>(qh_pointid(qh, vertex->point)));
        std::ranges::sort(numbers);
        return numbers;
    }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> messages_;
    qhT state_;
};

}  // namespace

std::vector<std::uint32_t> visible_points(std::span<const glm::dvec3> positions,
                                          const glm::dvec3& viewpoint, double sphere) {
    RIMLINE_CHECK(sphere > 1.0 && positions.size() < std::size_t{1} << 31);
    std::vector<std::uint32_t> all(positions.size());
    std::iota(all.begin(), all.end(), 0u);
    double farthest = 0.0;
    for (const glm::dvec3& p : positions)
        farthest = std::max(farthest, glm::distance(p, viewpoint));
    if (positions.size() < 4 || farthest == 0.0) return all;
    std::vector<glm::dvec3> flipped;
    flipped.reserve(positions.size() + 1);
    for (const glm::dvec3& p : positions) {
        const glm::dvec3 to = (p - viewpoint) / farthest;
        const double length = glm::length(to);
        flipped.push_back(length > 0.0 ? to + 2.0 * (sphere - length) / length * to : to);
    }
    flipped.emplace_back(0.0);
    Hull hull;
    std::vector<std::uint32_t> visible = hull.vertices(flipped);
    if (visible.empty()) return all;
    if (visible.back() == positions.size()) visible.pop_back();  // The viewpoint.
    return visible;
}

}  // namespace rimline::tools
