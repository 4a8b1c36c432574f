#pragma once

// What is left to do with a drawn picture before it is written: its alpha is made for viewers, a translucent
// background is laid under it, and a mask is made exact.
//
// The renderer blends linear light. Viewers of PNG blend the encoded values, which makes dark colors heavier and
// light ones thinner: a shadow of half the light would become one of a fifth. So alpha a of a pixel with the linear
// color C becomes, with the encoding e of sRGB,
//
//     over white   e(C) a' + 1 - a' = e(C a + 1 - a),   so   a' = (1 - e(C a + 1 - a)) / (1 - e(C))
//     over black   e(C) a'          = e(C a),           so   a' = e(C a) / e(C)
//
// where each equation says that viewers show what the renderer would. The first is right for black over every color,
// because e is nearly a power, and the second for white. Colors between take the mean of the two, weighted by the
// squares of 1 - e(C) and of e(C).

#include <optional>

#include "silhouette/picture.h"
#include "tools/options/color.h"

namespace rimline::tools {

struct PictureFinish {
    /// The picture was drawn without background (Scene::has_background), and its alpha is written.
    bool has_alpha = false;
    std::optional<Color> under{};  ///< Laid under a picture with alpha.
    /// Each pixel becomes black or white, whichever it is nearer to in linear light, and opaque or transparent.
    bool is_mask = false;

    /// O(pixels).
    void apply(Picture& picture) const;
};

}  // namespace rimline::tools
