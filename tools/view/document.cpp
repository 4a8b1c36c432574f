#include "tools/view/document.h"

#include <utility>

namespace rimline::tools {

Opened open_named(const CloudArgument& named, const BeginCall& begin) {
    if (!named.as_points && !named.drop_bad) {
        MeshSource source =
            load_model(named.model, named.subdivide, FaceRequirement::faces_or_points, begin);
        if (!source.triangles.empty())
            return std::make_unique<OpenedModel>(named.model, source, begin);
        // Read again below, with all that it says of points.
    }
    return std::make_unique<OpenedCloud>(named, begin);
}

}  // namespace rimline::tools
