#include "server/worker/capabilities.h"

#include "metamer/v1/scene.pb.h"
#include "server/models/models.h"

namespace metamer {

v1::Capabilities capabilities(unsigned threads) {
  v1::Capabilities result;
  result.add_backend("cpu");
  result.set_threads(threads);
  const auto* methods = v1::Method::descriptor()->FindOneofByName("method");
  for (int i = 0; i < methods->field_count(); ++i) result.add_method(methods->field(i)->name());
  for (const models::ModelInfo& info : models::registry()) {
    v1::ModelInfo* model = result.add_model();
    model->set_name(info.name);
    model->set_citation(info.citation);
    for (const models::ParameterInfo& parameter : info.parameters) {
      v1::ParameterInfo* to = model->add_parameter();
      to->set_name(parameter.name);
      to->set_default_value(parameter.default_value);
      to->set_min(parameter.min);
      to->set_max(parameter.max);
      to->set_unit(parameter.unit);
      to->set_meaning(parameter.meaning);
    }
  }
  return result;
}

}  // namespace metamer
