#include "tools/options/drawing_device.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace rimline::tools {

nlohmann::ordered_json device_json(const DrawingDevice* device) {
    nlohmann::ordered_json json{
        {"device", nullptr}, {"driver", nullptr}, {"validation_messages", nullptr}};
    if (!device) return json;
    json["device"] = device->device.facts().name;
    json["driver"] = device->device.facts().driver;
    if (const auto count = device->instance.validation_message_count())
        json["validation_messages"] = *count;
    return json;
}

void print_validation(const DrawingDevice& device) {
    if (const auto count = device.instance.validation_message_count())
        std::printf("  validation  %u messages%s%s\n", *count, *count ? ", the first: " : "",
                    *count ? device.instance.first_validation_message().c_str() : "");
}

}  // namespace rimline::tools
