#pragma once

#include "engine/scene/scene.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace dollytrack {

/// What an operation (operation.h) calls an object: its name where that is unique (it holds while
/// the numbers change), else its number.
nlohmann::json objectKey(const Scene& scene, int id);
nlohmann::json objectKeys(const Scene& scene, const std::vector<int>& ids);

}  // namespace dollytrack
