#pragma once

// Embree, of Debian 12 (version 3) and of newer systems (version 4), by the same names.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace rimline::tools {

#if RTC_VERSION_MAJOR >= 4
using RayContext = RTCRayQueryContext;
constexpr RTCSceneFlags k_filtered_by_query = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using RayContext = RTCIntersectContext;
constexpr RTCSceneFlags k_filtered_by_query = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// Finds the first surface of `scene` on the ray.
inline void find_first(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &ray);
#else
    RayContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
}

/// Whether a surface that `filter` leaves in lies on the ray. The scene has the flag k_filtered_by_query; the filter
/// receives a pointer to `context`.
inline bool is_blocked(RTCScene scene, RTCRay ray, RayContext& context, RTCFilterFunctionN filter) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    arguments.context = &context;
    arguments.filter = filter;
    rtcOccluded1(scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&context);
    context.filter = filter;
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar < 0.0f;
}

}  // namespace rimline::tools
