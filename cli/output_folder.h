#pragma once
// The folder that a run writes into.

#include <filesystem>
#include <string>
#include <vector>

#include "core/contract.h"

namespace grimaldi {

/// "DIR/city.toml" → "city.out" (in the working folder); no scenario → "grimaldi.out".
std::filesystem::path default_output_folder(const std::filesystem::path& scenario);

class OutputFolder {
 public:
  /// `files`: what a result may consist of; the first one is in every result.
  explicit OutputFolder(std::filesystem::path folder,
                        std::vector<std::string> files = {"result.h5", "coverage.png", "profiles.png", "summary.json"})
      : folder_(std::move(folder)), files_(std::move(files)) {}

  /// Errors to `diagnostics`, with nothing touched: the path or one above it is no folder, it may not be written, it
  /// holds the first file of a result and `overwrite` is false, a folder lies where a file is to be.
  void check(bool overwrite, Diagnostics& diagnostics) const;
  /// Makes the folder and those above it. Throws InputErrors if that fails.
  void create();
  /// Takes away the folders that `create` made, if nothing lies in them.
  void remove_if_empty();
  /// Takes away those files of an older result that this run has not written.
  void remove_stale(const std::vector<std::string>& written) const;

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::string> files_;
  std::vector<std::filesystem::path> created_;  // the outermost first
};

}  // namespace grimaldi
