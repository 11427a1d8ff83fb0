#include "cli/output_folder.h"

#include <unistd.h>

#include <algorithm>

namespace grimaldi {
namespace {

namespace fs = std::filesystem;

// The folder itself if it is there, else the nearest one above it.
fs::path nearest_existing(fs::path folder) {
  std::error_code fault;
  folder = fs::absolute(folder).lexically_normal();
  while (!fs::exists(folder, fault) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace

fs::path default_output_folder(const fs::path& scenario) {
  const std::string stem = scenario.stem().string();
  return (stem.empty() ? "grimaldi" : stem) + ".out";
}

void OutputFolder::check(bool overwrite, Diagnostics& diagnostics) const {
  std::error_code fault;
  const std::string name = folder_.string();
  const fs::path there = nearest_existing(folder_);
  if (!fs::is_directory(there, fault)) {
    diagnostics.error(name, 0, "-o", "cannot be a folder", there.string() + " is a file", "choose another folder");
    return;
  }
  if (access(there.c_str(), W_OK | X_OK) != 0) {
    diagnostics.error(name, 0, "-o", "cannot be written", "no permission to write in " + there.string(),
                      "choose another folder with -o");
    return;
  }
  for (const std::string& file_name : files_)
    if (fs::is_directory(file(file_name), fault))
      diagnostics.error(file(file_name).string(), 0, "-o", "cannot be written", "a folder of that name is there",
                        "choose another folder with -o");
  if (!overwrite && fs::exists(file(files_.front()), fault))
    diagnostics.error(file(files_.front()).string(), 0, "-o", "a result is already there", "it would be lost",
                      "choose another folder with -o, or replace it with --overwrite");
}

void OutputFolder::create() {
  std::vector<fs::path> absent;
  std::error_code fault;
  for (fs::path folder = fs::absolute(folder_ / "").lexically_normal().parent_path();
       !fs::exists(folder, fault) && folder.has_relative_path(); folder = folder.parent_path())
    absent.push_back(folder);
  std::reverse(absent.begin(), absent.end());
  for (const auto& folder : absent) {
    if (fs::create_directory(folder, fault)) created_.push_back(folder);
    if (fault) {
      remove_if_empty();
      input_error(folder_.string(), 0, "-o", "cannot be made", fault.message(), "choose another folder with -o");
    }
  }
}

void OutputFolder::remove_if_empty() {
  for (auto folder = created_.rbegin(); folder != created_.rend(); ++folder)
    rmdir(folder->c_str());  // fails, as it should, where something lies in it
  created_.clear();
}

void OutputFolder::remove_stale(const std::vector<std::string>& written) const {
  std::error_code fault;  // a file that cannot be removed does no harm
  for (const std::string& name : files_)
    if (std::find(written.begin(), written.end(), name) == written.end()) fs::remove(file(name), fault);
}

}  // namespace grimaldi
