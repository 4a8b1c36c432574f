#include "tools/options/model_octree.h"

#include "silhouette/mesh/solid.h"
#include "tools/options/model_argument.h"
#include "tools/progress.h"

namespace rimline::tools {

bool check_solid(const Mesh& mesh, const Context& context) {
    Progress progress(context, "asking whether it is a solid");
    return is_solid(mesh, progress.call());
}

HoughOctree build_octree(const std::string& model, const Mesh& mesh, const Context& context,
                         const HoughOctreeOptions& options) {
    return about_model(model, [&] {
        Progress progress(context, "building the octree");
        HoughOctree octree(mesh, options, progress.call());
        context.times.end("index");
        return octree;
    });
}

}  // namespace rimline::tools
