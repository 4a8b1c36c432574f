// A file of a point cloud: either it is read, with one normal and color for each point or none, or there is a message.

#include <cstddef>
#include <cstdint>

#include "silhouette/mesh/formats/point_file.h"
#include "silhouette/points/point_cloud.h"
#include "tests/fuzz/fuzz_input.h"

using namespace rimline;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const std::string name = "fuzz.xyz";
    for (const BadPoints bad : {BadPoints::refuse, BadPoints::keep}) {
        try {
            PointSource source = read_point_bytes(name, bytes, ".xyz", bad);
            const std::size_t count = source.positions.size();
            fuzz::require(count > 0, "no points and no message");
            fuzz::require(source.normals.empty() || source.normals.size() == count, "normals");
            fuzz::require(source.colors.empty() || source.colors.size() == count, "colors");
            const PointCloud cloud(std::move(source));
            fuzz::require(cloud.size() + cloud.duplicate_count() + cloud.dropped_count() == count,
                          "points are lost");
            fuzz::require(std::isfinite(cloud.radius()), "the radius is not finite");
        } catch (const Error& error) {
            fuzz::require_message(error.what(), name);
        }
    }
    return 0;
}
