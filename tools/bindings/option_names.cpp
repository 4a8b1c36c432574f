#include "tools/bindings/option_names.h"

#include <cctype>

namespace rimline::tools {

std::string with_plain_names(std::string message, char joint) {
    for (std::size_t at = 0; (at = message.find("--", at)) != std::string::npos;) {
        // Not in a value or a path that the message tells.
        const bool is_name = (at == 0 || message[at - 1] == ' ' || message[at - 1] == '(') &&
                             at + 2 < message.size() && std::islower(message[at + 2]) != 0;
        if (!is_name) {
            at += 2;
            continue;
        }
        message.erase(at, 2);
        for (; at < message.size() && (std::islower(message[at]) != 0 || message[at] == '-'); ++at)
            if (message[at] == '-') message[at] = joint;
    }
    return message;
}

}  // namespace rimline::tools
