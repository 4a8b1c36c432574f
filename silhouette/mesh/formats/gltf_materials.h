#pragma once

// The materials of a glTF document: their base colors and how they use textures. A material may have the diffuse color
// of KHR_materials_pbrSpecularGlossiness instead, an archived extension that many files still use.

#include "silhouette/mesh/formats/gltf_place.h"
#include "silhouette/mesh/formats/gltf_scene.h"

namespace rimline {

/// Fills the images, textures, materials and warnings of `scene`, whose views must be there. Throws as
/// read_gltf_scene(). Cost: O(document), however many materials name the same texture.
void read_gltf_materials(const GltfPlace& root, GltfScene& scene, const LongCall& call);

}  // namespace rimline
