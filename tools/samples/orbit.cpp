#include <cmath>
#include <cstdio>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/rimline.h"

int main() {
    const rimline::Mesh mesh(rimline::make_built_in_shape("knot", 20'000));
    const rimline::HoughOctree octree(mesh);  // Once a mesh: any number of trackers share it.

    const auto on_orbit = [&](float angle_rad) {
        const glm::vec3 offset(std::cos(angle_rad), 0.25f, std::sin(angle_rad));
        const float distance = 3.0f * static_cast<float>(mesh.radius());
        return rimline::HomogeneousPoint::viewpoint(glm::vec3(mesh.center()) + distance * offset);
    };

    rimline::SilhouetteTracker tracker(octree, on_orbit(0.0f));  // Once a camera or a light.
    for (int frame = 1; frame <= 10; ++frame) {
        const auto& changes = tracker.move_to(on_orbit(0.01f * static_cast<float>(frame)));
        std::printf("frame %2d: %u edges, %zu joined, %zu left\n", frame, changes.silhouette_size,
                    changes.added.size(), changes.removed.size());
    }
}
