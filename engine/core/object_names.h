#pragma once

#include <map>
#include <string>

namespace dollytrack {

/// Makes unique object names: "Dining Chair", "Dining Chair_2", ...
class ObjectNames {
  public:
    std::string next(const std::string& base) {
        const int count = ++used_[base];
        return count == 1 ? base : base + "_" + std::to_string(count);
    }

  private:
    std::map<std::string, int> used_;
};

}  // namespace dollytrack
