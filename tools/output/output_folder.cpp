#include "tools/output/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "silhouette/error.h"
#include "tools/command.h"
#include "tools/input_files.h"

namespace rimline::tools {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path, const char* what) : path_(std::move(path)) {
    if (path_.empty()) throw UsageError("-o: expected the name of a folder, not ''");
    if (path_ == "-") throw UsageError("-o -: pictures are in a folder; give its name");
    if (path_.extension() == ".png" && !fs::is_directory(path_))
        throw UsageError(path_.string() + ": expected the name of a folder, not of a PNG file");
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::io, path_.string() + ": cannot write " + what + ": " + why);
    };
    std::error_code error;
    const fs::path parent = (path_.has_filename() ? path_ : path_.parent_path()).parent_path();
    if (!parent.empty() && !fs::exists(parent, error))
        fail("there is no folder " + parent.string() + "; create it first");
    own_.make(path_, [&](const fs::path& folder) {
        return fs::create_directory(folder, error) ? 0
               : error.value() != 0                ? error.value()
                                                   : EEXIST;
    });
    if (!fs::is_directory(path_)) fail(fs::exists(path_) ? "it is not a folder" : error.message());
    if (access(path_.c_str(), W_OK | X_OK) != 0) fail(std::generic_category().message(errno));
}

void OutputFolder::remove_numbered(const std::string& prefix, std::size_t min_digits) const {
    constexpr std::string_view k_ending = ".png";
    std::vector<fs::path> old;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) {
        const std::string name = entry.path().filename().string();
        if (name.size() <= prefix.size() + k_ending.size() || !name.starts_with(prefix) ||
            !name.ends_with(k_ending) || !entry.is_regular_file(error))
            continue;
        const std::string_view digits = std::string_view(name).substr(
            prefix.size(), name.size() - prefix.size() - k_ending.size());
        if (digits.size() >= min_digits &&
            digits.find_first_not_of("0123456789") == std::string_view::npos)
            old.push_back(entry.path());
    }
    for (const fs::path& file : old) check_is_no_input(file);
    for (const fs::path& file : old)
        if (!fs::remove(file, error) && error)
            throw Error(ErrorCode::io, file.string() + ": cannot remove it: " + error.message());
}

}  // namespace rimline::tools
