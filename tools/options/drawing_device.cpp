#include "tools/options/drawing_device.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace rimline::tools {

nlohmann::ordered_json device_json(const DrawingDevice* drawn) {
    nlohmann::ordered_json json{
        {"device", nullptr}, {"driver", nullptr}, {"validation_messages", nullptr}};
    if (!drawn) return json;
    json["device"] = drawn->device.facts().name;
    json["driver"] = drawn->device.facts().driver;
    if (const auto count = drawn->instance.validation_message_count())
        json["validation_messages"] = *count;
    return json;
}

void print_validation(const DrawingDevice& drawn) {
    if (const auto count = drawn.instance.validation_message_count())
        std::printf("  validation  %u messages%s%s\n", *count, *count ? ", the first: " : "",
                    *count ? drawn.instance.first_validation_message().c_str() : "");
}

}  // namespace rimline::tools
