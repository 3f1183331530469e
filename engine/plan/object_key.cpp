#include "engine/plan/object_key.h"

#include <algorithm>
#include <string>

namespace dollytrack {

using nlohmann::json;

json objectKey(const Scene& scene, int id) {
    const std::string& name = scene.object(id).name;
    const auto same = std::ranges::count(scene.objects, name, &Object::name);
    if (name.empty() || same != 1) return id;
    return name;
}

json objectKeys(const Scene& scene, const std::vector<int>& ids) {
    json keys = json::array();
    for (const int id : ids) keys.push_back(objectKey(scene, id));
    return keys;
}

}  // namespace dollytrack
