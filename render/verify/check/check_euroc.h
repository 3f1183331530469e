#pragma once

#include "render/verify/check.h"

namespace dollytrack::verify {

CheckWork beginEuroc(const Subject& subject, Findings& findings);

}  // namespace dollytrack::verify
