#include "tools/options/picture_finish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>

#include "silhouette/srgb.h"

namespace rimline::tools {

namespace {

using LinearTable = std::array<float, 256>;

LinearTable linear_table() {
    LinearTable table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = linear_from_srgb(glm::vec3(float(i) / 255.0f)).x;
    return table;
}

float encoded(float linear) { return srgb_from_linear(glm::vec3(linear)).x; }

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

float mean_light(const std::uint8_t* pixel, const LinearTable& linear) {
    return (linear[pixel[0]] + linear[pixel[1]] + linear[pixel[2]]) / 3.0f;
}

void make_exact(std::uint8_t* pixel, const LinearTable& linear) {
    const bool is_opaque = pixel[3] >= 128;
    const bool is_lit = is_opaque && mean_light(pixel, linear) >= 0.5f;
    std::fill_n(pixel, 3, is_lit ? std::uint8_t{255} : std::uint8_t{0});
    pixel[3] = is_opaque ? 255 : 0;
}

void encode_alpha(std::uint8_t* pixel, const LinearTable& linear) {
    if (pixel[3] == 0 || pixel[3] == 255) return;
    const float alpha = float(pixel[3]) / 255.0f;
    const float light = mean_light(pixel, linear);
    const float own = encoded(light);
    const float darkness = (1.0f - own) * (1.0f - own), lightness = own * own;
    float sum = 0.0f;
    if (own < 1.0f) sum += darkness * (1.0f - encoded(light * alpha + 1.0f - alpha)) / (1.0f - own);
    if (own > 0.0f) sum += lightness * encoded(light * alpha) / own;
    pixel[3] = byte_of(sum / (darkness + lightness));
}

void lay_under(std::uint8_t* pixel, const Color& under) {
    const float over_alpha = float(pixel[3]) / 255.0f;
    const float under_alpha = (1.0f - over_alpha) * float(under.alpha) / 255.0f;
    const float alpha = over_alpha + under_alpha;
    const std::array<std::uint8_t, 3> below{under.red, under.green, under.blue};
    for (std::size_t channel = 0; alpha > 0.0f && channel < 3; ++channel) {
        const float sum = over_alpha * float(pixel[channel]) + under_alpha * float(below[channel]);
        pixel[channel] = byte_of(sum / (255.0f * alpha));
    }
    pixel[3] = byte_of(alpha);
}

}  // namespace

void PictureFinish::apply(Picture& picture) const {
    picture.has_alpha = has_alpha;
    if (!has_alpha && !is_mask) return;
    const LinearTable linear = linear_table();
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        std::uint8_t* pixel = &picture.rgba[i];
        if (is_mask) make_exact(pixel, linear);
        if (has_alpha) encode_alpha(pixel, linear);
        if (has_alpha && under) lay_under(pixel, *under);
    }
}

}  // namespace rimline::tools
