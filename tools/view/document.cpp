#include "tools/view/document.h"

#include <utility>

#include "tools/options/double_faces.h"

namespace rimline::tools {

Document open_document(const CloudArgument& argument, const BeginCall& begin) {
    if (!argument.as_points && !argument.drop_bad) {
        MeshSource source =
            load_model(argument.model, argument.subdivide, FaceRequirement::faces_or_points, begin,
                       TexturePictures::read);
        if (!source.triangles.empty()) {
            draw_double_faces_once(argument.model, source);
            return std::make_unique<ModelDocument>(argument.model, source, begin);
        }
        // Read again below, with the attributes of its points.
    }
    return std::make_unique<CloudDocument>(argument, begin);
}

}  // namespace rimline::tools
