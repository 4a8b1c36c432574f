#include "tools/bench/ceiling.h"

#include "tools/bench/targets.h"

namespace rimline::tools {

namespace {

struct Known {
    std::uint32_t faces;
    double extraction_us;
    double face_bits_us;
};
constexpr Known k_known[] = {{k_bunny_faces, 63.0, 14.0}, {k_igea_faces, 330.0, 137.0}};
constexpr double k_allowance = 1.25;

}  // namespace

PlainLoop::PlainLoop(const Mesh& mesh) : kernel_(best_version<Kernel>()) {
    for (const Plane& plane : mesh.planes()) {
        nx_.push_back(plane.nx);
        ny_.push_back(plane.ny);
        nz_.push_back(plane.nz);
        d_.push_back(plane.d);
    }
}

std::uint32_t PlainLoop::count_front(const HomogeneousPoint& point) const {
    return kernel_(nx_.data(), ny_.data(), nz_.data(), d_.data(), d_.size(), point.x, point.y,
                   point.z, point.w);
}

std::optional<BruteForceCeiling> brute_force_ceiling(std::uint32_t faces,
                                                     std::string_view instruction_set,
                                                     double plain_us, double measured_us) {
    for (const Known& known : k_known)
        if (known.faces == faces)
            return BruteForceCeiling{
                plain_us, measured_us,
                k_allowance * known.extraction_us * plain_us / known.face_bits_us,
                instruction_set == "AVX-512"};
    return std::nullopt;
}

}  // namespace rimline::tools
