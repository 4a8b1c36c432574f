#ifndef RIMLINE_SHADERS_ROUND_TO_EVEN_GLSL
#define RIMLINE_SHADERS_ROUND_TO_EVEN_GLSL

// Rounding of 32-bit floats to nearest even (RoundingModeRTE) for the whole module. Only for modules
// that run where DeviceContext::round_to_nearest_float32 is true: other devices may not be given them.

#extension GL_EXT_spirv_intrinsics : require

spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4467], 4462, 32);

#endif
