#pragma once

#include <map>
#include <string>
#include <vector>

namespace dollytrack {

/// Makes unique object names: "Dining Chair", "Dining Chair_2", ...
class ObjectNames {
  public:
    std::string next(const std::string& base);

  private:
    std::map<std::string, int> used_;
};

/// A list of at most `most` names as text: "a, b and 7 more".
std::string listOf(const std::vector<std::string>& names, std::size_t most = 20);

/// A count with the singular or plural: "1 model was", "2 models were".
std::string counted(std::size_t count, const char* one, const char* many);

}  // namespace dollytrack
