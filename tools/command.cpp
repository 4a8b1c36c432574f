#include "tools/command.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace rimline::tools {

void print_json(const nlohmann::ordered_json& object) {
    const std::string text = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fputc('\n', stdout);
}

}  // namespace rimline::tools
