#pragma once

// A model as the window opens it, for tests without a window.

#include <memory>
#include <string>

#include "tools/options/model_argument.h"
#include "tools/view/model_document.h"

namespace rimline::tests {

inline std::unique_ptr<tools::ModelDocument> opened_model(const std::string& name) {
    const auto begin = [](const std::string&) { return LongCall{}; };
    return std::make_unique<tools::ModelDocument>(
        name, tools::load_drawn_model(name, 0, begin, tools::TexturePictures::read), begin);
}

}  // namespace rimline::tests
