#pragma once

#include "render/verify/image_files.h"

#include <string>

namespace dollytrack::verify {

/// What is wrong where the change of colours at the borders of what the ids show is not more than
/// `least_ratio` times that beside them; empty where it is, and where there is too little to say.
/// `of_things_alone` leaves borders with nothing (id 0) out.
std::string wrongEdges(const Image8& picture, const Image16& ids, bool of_things_alone,
                       double least_ratio);

}  // namespace dollytrack::verify
