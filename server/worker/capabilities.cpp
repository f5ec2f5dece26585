#include "server/worker/capabilities.h"

#include "common/models/registry.h"
#include "common/spectral/cie.h"
#include "common/spectral/optical_constants.h"
#include "metamer/v1/scene.pb.h"
#include "server/methods/method.h"

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

void set(const std::string& name, const Features& features, v1::FeatureSet& to) {
  to.set_name(name);
  for (std::size_t i = 0; i < feature_names().size(); ++i)
    if (features.has(static_cast<Feature>(i))) to.add_feature(feature_names()[i]);
}

void add_choice(const std::string& field, const std::vector<std::string>& words,
                v1::Capabilities& to) {
  v1::Choice& choice = *to.add_choice();
  choice.set_field(field);
  choice.mutable_word()->Assign(words.begin(), words.end());
}

std::vector<std::string> names_of(const auto& table) {
  std::vector<std::string> names;
  for (const auto& one : table) names.emplace_back(one.name);
  return names;
}

/// The words of the schema's strings, by message and field.
void add_choices(v1::Capabilities& to) {
  add_choice("spectrum.standard", cie::illuminant_names(), to);
  add_choice("dielectric.medium", names_of(media()), to);
  add_choice("conductor.metal", names_of(metals()), to);
}

}  // namespace

v1::Capabilities capabilities(const WorkerOptions& options,
                              const std::vector<std::pair<std::string, Features>>& backends) {
  v1::Capabilities result;
  result.add_backend(options.backend->name());
  options.backend->describe(result);
  for (const auto& [name, features] : backends) set(name, features, *result.add_backend_features());
  result.set_threads(options.threads);
  const auto add_method = [&](const std::string& name, const v1::Method& method) {
    result.add_method(name);
    set(name, method_features(method), *result.add_method_features());
  };
  const auto* methods = v1::Method::descriptor()->FindOneofByName("method");
  for (int i = 0; i < methods->field_count(); ++i) {
    const auto* field = methods->field(i);
    v1::Method method;
    method.GetReflection()->MutableMessage(&method, field);
    add_method(field->name(), method);
  }
  add_method("auto", {});  // what clients offer beside them: a goal
  using models::Kind;
  for (const Kind kind : {Kind::model, Kind::diffuse, Kind::slope, Kind::attenuation})
    for (const models::Entry& entry : models::registry(kind)) add(entry, result);
  add_choices(result);
  return result;
}

}  // namespace metamer::worker
