#ifndef RIMLINE_SHADERS_DRAW_GLSL
#define RIMLINE_SHADERS_DRAW_GLSL

// The inputs of every drawing pass (engine/frame/draw_data.h).

#include "layout.h"

layout(push_constant, scalar) uniform Constants { DrawConstants draw; };

layout(set = 0, binding = 0, scalar) uniform FrameBlock { FrameData frame; };
layout(set = 0, binding = 1, scalar) uniform InstanceBlock { InstanceData instance; };
layout(set = 0, binding = 2, scalar) uniform LightBlock { LightData light; };

#endif
