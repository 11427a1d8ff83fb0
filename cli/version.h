#pragma once
// The version of the program.

namespace grimaldi {

/// "MAJOR.MINOR.PATCH", as the build says.
const char* program_version();

}  // namespace grimaldi
