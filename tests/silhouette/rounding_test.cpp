// Doubles that become floats are rounded, also where they become doubles again at once: for points that are tested as
// floats and computed with as doubles. gcc 12 leaves it out for two doubles beside each other
// (silhouette/CMakeLists.txt).

#include <doctest/doctest.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace rimline {
namespace {

// Through a pointer that changes, so that the compiler knows neither the numbers nor the function.
template <typename Doubles, typename Floats>
void round(const Doubles& numbers, Doubles& rounded) {
    rounded = Doubles(Floats(0.4 * numbers));
}
template <typename Doubles>
using Rounding = void (*volatile)(const Doubles&, Doubles&);

double rounded_alone(double number) {
    const volatile float stored = static_cast<float>(0.4 * number);
    return stored;
}

template <typename Doubles, typename Floats>
void check(const Doubles& numbers) {
    const Rounding<Doubles> rounding = round<Doubles, Floats>;
    Doubles found;
    rounding(numbers, found);
    for (int i = 0; i < Doubles::length(); ++i) CHECK(found[i] == rounded_alone(numbers[i]));
}

TEST_CASE("doubles are rounded to floats where they become doubles again") {
    for (double x = 0.1; x < 2.0; x += 0.1) {
        check<glm::dvec2, glm::vec2>({x, 2.0 * x});
        check<glm::dvec3, glm::vec3>({x, 2.0 * x, 3.0 * x});
        check<glm::dvec4, glm::vec4>({x, 2.0 * x, 3.0 * x, 5.0 * x});
    }
}

}  // namespace
}  // namespace rimline
