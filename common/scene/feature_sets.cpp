#include "common/scene/feature_sets.h"

#include <algorithm>
#include <cctype>

namespace metamer {

std::string name_of(v1::Backend backend) {
  std::string name = v1::Backend_Name(backend);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

bool has_feature(const v1::Capabilities& capabilities, v1::Backend backend, Feature feature) {
  const std::string name = name_of(backend);
  const auto& sets = capabilities.backend_features();
  const auto set = std::find_if(sets.begin(), sets.end(),
                                [&](const v1::FeatureSet& one) { return one.name() == name; });
  return set == sets.end() || std::find(set->feature().begin(), set->feature().end(),
                                        name_of(feature)) != set->feature().end();
}

}  // namespace metamer
