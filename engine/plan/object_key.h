#pragma once

#include "engine/scene/scene.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace dollytrack {

/// How an operation (operation.h) refers to an object: by its name if that is unique, because names
/// stay valid when numbers change; else by its number.
nlohmann::json objectKey(const Scene& scene, int id);
nlohmann::json objectKeys(const Scene& scene, const std::vector<int>& ids);

}  // namespace dollytrack
