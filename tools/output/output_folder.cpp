#include "tools/output/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "silhouette/error.h"

namespace rimline::tools {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path, const char* what) : path_(std::move(path)) {
    if (path_.empty()) throw Error(ErrorCode::io, "the output folder's name is empty");
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::io, path_.string() + ": cannot write " + what + ": " + why);
    };
    std::error_code error;
    is_own_ = fs::create_directory(path_, error);
    if (!fs::is_directory(path_)) fail(fs::exists(path_) ? "it is not a folder" : error.message());
    if (access(path_.c_str(), W_OK | X_OK) != 0) fail(std::generic_category().message(errno));
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    if (is_own_) fs::remove(path_, ignored);  // Fails if the folder is not empty.
}

}  // namespace rimline::tools
