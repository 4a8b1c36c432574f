#ifndef RIMLINE_SHADERS_SURFACE_TEXTURE_GLSL
#define RIMLINE_SHADERS_SURFACE_TEXTURE_GLSL

// The texture of a surface. `uv` stays in the triangle, so neighboring pixels at its border are not a pixel
// apart in it. The coordinates of pixel centers are, so they choose the mip level.

layout(set = 1, binding = 0) uniform sampler2D surface_texture;

layout(location = 4) centroid in vec2 uv;
layout(location = 5) in vec2 center_uv;

vec3 texture_color() {
    return textureGrad(surface_texture, uv, dFdx(center_uv), dFdy(center_uv)).rgb;
}

#endif
