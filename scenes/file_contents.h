#pragma once
// A file as bytes, read at once, with a message that helps when it cannot be read.

#include <filesystem>
#include <optional>
#include <string>

#include "core/contract.h"

namespace grimaldi {

/// What keeps a file from being read, in the words of a Diagnostic.
struct FileFault {
  std::string problem, why, suggestion;
};

/// Nothing if `file` is a regular file that holds at least one byte. Else: not there (with the nearest name in that
/// folder), a folder, not a regular file, empty, or what the system says. Never throws for what it finds on disk.
std::optional<FileFault> file_fault(const std::filesystem::path& file);

/// The bytes of `file` through one read. Nothing after one error to `diagnostics`: a `file_fault`, or not readable.
std::optional<std::string> read_file_contents(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace grimaldi
