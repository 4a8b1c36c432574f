#ifndef RIMLINE_SHADERS_DRAW_GLSL
#define RIMLINE_SHADERS_DRAW_GLSL

// The push constants of every drawing pass.

#include "layout.h"

layout(push_constant, scalar) uniform Constants { DrawConstants draw; };

#endif
