#include "tools/view/document.h"

#include <utility>

namespace rimline::tools {

Document open_named(const CloudArgument& named, const BeginCall& begin) {
    if (!named.as_points && !named.drop_bad) {
        MeshSource source =
            load_model(named.model, named.subdivide, FaceRequirement::faces_or_points, begin);
        if (!source.triangles.empty())
            return std::make_unique<ModelDocument>(named.model, source, begin);
        // Read again below, with all that it says of points.
    }
    return std::make_unique<CloudDocument>(named, begin);
}

}  // namespace rimline::tools
