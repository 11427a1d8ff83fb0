#include "validation/cases/families.h"

namespace grimaldi {

Cases extreme_engine_cases() { return {}; }

}  // namespace grimaldi
