#include "tools/bench/ceiling.h"

namespace rimline::tools {

namespace {

constexpr double k_allowance = 1.25;
constexpr double k_plain_loops = 1.6;

}  // namespace

PlainLoop::PlainLoop(const Mesh& mesh)
    : face_kernel_(best_version<FaceKernel>()), edge_kernel_(best_version<EdgeKernel>()) {
    for (const Plane& plane : mesh.planes()) {
        nx_.push_back(plane.nx);
        ny_.push_back(plane.ny);
        nz_.push_back(plane.nz);
        d_.push_back(plane.d);
    }
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        faces_of_edges_.push_back(index(mesh.faces_of(EdgeId{e}).front()));
}

std::uint32_t PlainLoop::count_front(const HomogeneousPoint& point) const {
    return face_kernel_(nx_.data(), ny_.data(), nz_.data(), d_.data(), d_.size(), point.x, point.y,
                        point.z, point.w);
}

std::uint32_t PlainLoop::count_edges(std::uint32_t limit) const {
    return edge_kernel_(faces_of_edges_.data(), faces_of_edges_.size(), limit);
}

std::optional<BruteForceCeiling> brute_force_ceiling(std::uint32_t faces, double plain_us,
                                                     double measured_us) {
    if (faces < k_min_ceiling_faces) return std::nullopt;
    return BruteForceCeiling{plain_us, measured_us, k_allowance * k_plain_loops * plain_us};
}

}  // namespace rimline::tools
