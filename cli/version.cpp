#include "cli/version.h"

namespace grimaldi {

const char* program_version() { return GRIMALDI_VERSION; }

}  // namespace grimaldi
