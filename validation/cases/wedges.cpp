#include "validation/cases/families.h"

namespace grimaldi {

Cases wedge_cases() { return {}; }

}  // namespace grimaldi
