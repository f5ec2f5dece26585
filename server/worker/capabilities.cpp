#include "server/worker/capabilities.h"

#include "common/models/registry.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::worker {

namespace {

void add(const models::Entry& entry, v1::Capabilities& to) {
  v1::ModelInfo* model = to.add_model();
  model->set_kind(models::kind_name(entry.kind));
  model->set_name(entry.name);
  model->set_citation(entry.citation);
  model->set_equation(entry.equation);
  for (const models::Parameter& from : entry.parameters) {
    v1::ParameterInfo* parameter = model->add_parameter();
    parameter->set_name(from.name);
    parameter->set_default_value(from.default_value);
    parameter->set_min(from.min);
    parameter->set_max(from.max);
    parameter->set_unit(from.unit);
    parameter->set_meaning(from.meaning);
  }
}

}  // namespace

v1::Capabilities capabilities(const WorkerOptions& options) {
  v1::Capabilities result;
  options.backend->describe(result);
  result.set_threads(options.threads);
  const auto* methods = v1::Method::descriptor()->FindOneofByName("method");
  for (int i = 0; i < methods->field_count(); ++i) result.add_method(methods->field(i)->name());
  using models::Kind;
  for (const Kind kind : {Kind::model, Kind::diffuse, Kind::slope, Kind::attenuation})
    for (const models::Entry& entry : models::registry(kind)) add(entry, result);
  return result;
}

}  // namespace metamer::worker
