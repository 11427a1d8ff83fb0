#include "validation/cases/families.h"

namespace grimaldi {

Cases invariance_cases() { return {}; }

}  // namespace grimaldi
