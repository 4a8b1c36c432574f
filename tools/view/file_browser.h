#pragma once

// Choosing a file in the panel: the files opened last, which are kept for the next time, and folders to look
// through.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rimline::tools {

/// The names of the files opened last, newest first, in a text file, one a line. What cannot be read or written
/// is left alone: the list is a convenience.
class RecentFiles {
public:
    static constexpr std::size_t k_most = 10;

    /// `file` is read. Empty: the list is kept nowhere.
    explicit RecentFiles(std::filesystem::path file);

    const std::vector<std::string>& names() const noexcept { return names_; }
    /// To the front, as an absolute path, and into the file.
    void add(const std::string& name);

private:
    std::filesystem::path file_;
    std::vector<std::string> names_;
};

/// recent in the folder "rimline" of $XDG_STATE_HOME, or of .local/state in $HOME. Empty where the environment
/// names neither.
std::filesystem::path recent_files_path();

/// What a folder holds for the browser.
struct FolderListing {
    std::vector<std::string> folders;  ///< Without hidden ones, sorted.
    std::vector<std::string> files;    ///< Whose endings are of models and clouds, sorted.
};
/// Empty for a folder that cannot be read.
FolderListing list_folder(const std::filesystem::path& folder);

/// A line of a list in the window of the panel that is being drawn, to be clicked: true in the frame where it was.
/// Names are shown as they are, also those that ImGui would take for labels with a part for itself (after ##), and in
/// a tooltip where the list is too narrow.
bool draw_name(const std::string& name);
/// The same for a path: its last part, and then the folder, less clear.
bool draw_path(const std::string& path);

class FileBrowser {
public:
    /// Draws the list of `folder()`, into the window of the panel that is being drawn. Returns the file that
    /// was chosen.
    std::optional<std::string> draw(float height);
    const std::filesystem::path& folder() const noexcept { return folder_; }
    /// Lists the folder again.
    void refresh() { enter(folder_); }

private:
    void enter(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    FolderListing listing_;
};

}  // namespace rimline::tools
