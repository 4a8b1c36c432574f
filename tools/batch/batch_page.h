#pragma once

// The page of a batch: its pictures in a grid, and what went wrong.

#include <filesystem>
#include <string>
#include <vector>

namespace rimline::tools {

struct BatchPageItem {
    std::string input;
    std::vector<std::string> outputs;
    std::string error;  ///< Empty if the model is done.
};

/// An HTML page that lies in `folder`, from where it names outputs. Of a contact sheet and its views it shows the
/// sheet.
std::string batch_page(const std::vector<BatchPageItem>& items,
                       const std::filesystem::path& folder);

}  // namespace rimline::tools
