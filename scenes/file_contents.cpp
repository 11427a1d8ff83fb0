#include "scenes/file_contents.h"

#include <algorithm>
#include <fstream>
#include <new>
#include <system_error>
#include <vector>

namespace grimaldi {
namespace {

namespace fs = std::filesystem;

// Enough for any folder of meshes; a search through more would make the user wait for a message.
constexpr std::size_t most_candidates = 10000;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator() && names.size() < most_candidates; entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_directory(ignored)) names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());  // the order of a folder is the file system's, messages must not depend on it
  return names;
}

FileFault not_there(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return {"no such file", "the folder \"" + folder.string() + "\" is not there", "check the path"};
  }
  const std::vector<std::string> names = names_in(folder);
  if (names.empty()) return {"no such file", "the folder \"" + folder.string() + "\" holds no files", "check the path"};
  return {"no such file", "nothing of this name in \"" + folder.string() + "\"",
          did_you_mean(file.filename().string(), names)};
}

}  // namespace

std::optional<FileFault> file_fault(const fs::path& file) {
  if (file.empty()) return FileFault{"no file named", "the name is empty", "give the path of a file"};
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return not_there(file);
  if (error) return FileFault{"cannot be read", error.message(), {}};
  if (status.type() == fs::file_type::directory)
    return FileFault{"is a folder", "a file is needed here", "name the file in it"};
  if (status.type() != fs::file_type::regular) {
    return FileFault{"is not a regular file", "a pipe or device has no size to hold against its contents",
                     "copy it to a file first"};
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return FileFault{"cannot be read", error.message(), {}};
  if (size == 0) return FileFault{"the file is empty", "it holds 0 bytes", "write it again"};
  return std::nullopt;
}

std::optional<std::string> read_file_contents(const fs::path& file, Diagnostics& diagnostics) {
  if (const std::optional<FileFault> fault = file_fault(file)) {
    diagnostics.error(file.string(), 0, {}, fault->problem, fault->why, fault->suggestion);
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    diagnostics.error(file.string(), 0, {}, "cannot be opened", "permission denied or too many open files",
                      "check its permissions");
    return std::nullopt;
  }
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  std::string contents;
  try {
    contents.resize(error ? 0 : static_cast<std::size_t>(size));
  } catch (const std::exception&) {  // bad_alloc or length_error
    diagnostics.error(file.string(), 0, {}, "too large for the memory", std::to_string(size) + " bytes",
                      "cut the scene into parts");
    return std::nullopt;
  }
  stream.read(contents.data(), static_cast<std::streamsize>(contents.size()));
  if (error || static_cast<std::size_t>(stream.gcount()) != contents.size()) {
    diagnostics.error(file.string(), 0, {}, "could not be read to its end", "it changed or the disk failed",
                      "try again");
    return std::nullopt;
  }
  return contents;
}

}  // namespace grimaldi
