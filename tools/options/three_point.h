#pragma once

// Three-point lighting: the key light is a sun, the last one of the scene. A fill light from the camera's other
// side brightens its shadows, and a rim light from behind and above brightens their edges. Both are large soft
// lights: they cast no shadows, and add nothing where the key light shines (Light::fills).

#include "engine/scene.h"

namespace rimline::tools {

/// Appends fill and rim for the scene's camera and its last light, a sun.
void add_fill_and_rim(Scene& scene);

/// The same for lights that have them: computes these again for another camera or key.
void move_fill_and_rim(Scene& scene);

}  // namespace rimline::tools
