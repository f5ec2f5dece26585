#include "tests/extremes/gl_build.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "server/gl/model_source.h"

namespace metamer::extremes {
namespace {

using models::Entry, models::Kind;

// A row in the shader's input: the angles, the vectors or u, its parameters, and a number and the
// parameters of each of its parts. Its output: the members of Lobes, or one value.
constexpr std::size_t parameter_count = models::max_parameters + 2;
constexpr std::size_t parameters_at = 13, parts_at = parameters_at + parameter_count;
constexpr std::size_t part_size = 1 + parameter_count, stride = parts_at + 3 * part_size;
constexpr std::size_t lobe_count = 7;
constexpr std::size_t group_size = 64;

std::string from_input(std::size_t at) { return "input_of[at + " + std::to_string(at) + "]"; }

/// "BeckmannSlope(input_of[at + 8])", with a comma before it; empty where there are no parameters.
std::string struct_from(const Entry& entry, std::size_t at) {
  if (entry.kind == Kind::attenuation) return ", " + from_input(at);
  const std::size_t count = entry.parameters.size() + (entry.kind == Kind::model ? 2 : 0);
  std::string text = ", " + gl::struct_name(entry) + "(";
  for (std::size_t i = 0; i < count; ++i) text += (i ? ", " : "") + from_input(at + i);
  return text + ")";
}

std::string call(const Entry& entry, std::size_t parameters) {
  return gl::function_name(entry) + "(a" + struct_from(entry, parameters) + ")";
}

/// The value of one of a kind, by the number in the row; `otherwise` where it is -1.
std::string choice(Kind kind, std::size_t at, const std::string& otherwise) {
  std::string text;
  for (const Entry& entry : models::registry(kind))
    text += from_input(at) + " == " + std::to_string(entry.index) + ".0 ? " + call(entry, at + 1) +
            " : ";
  return "(" + text + otherwise + ")";
}

std::string fresnel_call(const std::string& form) {
  std::string text = form + "(" + from_input(0);
  const int parameters = form == "conductor_fresnel" ? 2 : form == "index_from_reflectance" ? 0 : 1;
  for (int i = 0; i < parameters; ++i)
    text += ", " + from_input(parameters_at + static_cast<std::size_t>(i));
  return text + ")";
}

Kind kind_of(const Row& row) {
  if (row.kind == "models") return Kind::model;
  if (row.kind == "slopes") return Kind::slope;
  return row.kind == "diffuse" ? Kind::diffuse : Kind::attenuation;
}

/// The angles as they stand in the input, or as the shaders make them of vectors.
std::string angles_text(bool from_vectors) {
  if (!from_vectors) {
    std::string text = "Angles(";
    for (std::size_t i = 0; i < parameters_at; ++i) text += (i ? ", " : "") + from_input(i);
    return text + ")";
  }
  std::string text = "angles_of(";
  for (std::size_t i = 0; i < 12; i += 3)
    text += "vec3(" + from_input(i) + ", " + from_input(i + 1) + ", " + from_input(i + 2) + "), ";
  return text + from_input(12) + ", true, true)";
}

/// As shaders/stages/reflect.glsl has it; the answer is `sum`.
std::string ripples(const std::string& height, const std::string& spread, const std::string& nm) {
  return "  float k = 6283.1853 / " + nm + ";\n  Ripples r = ripples_of(" + height + ", " + spread +
         ", k * k, 5.0, 24.0, 1.0);\n  float sum = 0.0;\n"
         "  for (float i = 0.0; i < r.count; ++i) sum += ripple(r, k * k, i);\n";
}

std::string body(const Row& row) {
  if (row.kind == "fresnel") return "  output_of[to] = " + fresnel_call(row.form) + ";\n";
  if (row.kind == "ripples")
    return ripples(from_input(0), from_input(1), from_input(parameters_at)) +
           "  output_of[to] = sum;\n";
  std::string text = "  Angles a = " + angles_text(row.from_vectors) + ";\n";
  const auto index = static_cast<std::size_t>(index_of(kind_of(row), row.form));
  const Entry& entry =
      models::registry(kind_of(row))[index - (kind_of(row) == Kind::diffuse ? 1 : 0)];
  if (row.kind != "models") return text + "  output_of[to] = " + call(entry, parameters_at) + ";\n";
  text += "  Terms terms = Terms(" + choice(Kind::diffuse, parts_at, "a.n_dot_l") + ",\n    " +
          choice(Kind::slope, parts_at + part_size, "0.0") + ",\n    " +
          choice(Kind::attenuation, parts_at + 2 * part_size, "0.0") + ");\n";
  const std::string ripples_text = ripples("lobes.height", "lobes.spread", "550.0");
  text += "  Lobes lobes = " + gl::function_name(entry) + "(a, terms" +
          struct_from(entry, parameters_at) + ");\n";
  if (row.from_vectors)
    text += "  if (lobes.height >= 0.0) {\n" + ripples_text + "  lobes.fresnel *= sum;\n  }\n";
  int i = 0;
  for (const char* lobe : {"diffuse", "specular", "white", "fresnel", "cosine", "height", "spread"})
    text += "  output_of[to + " + std::to_string(i++) + "] = lobes." + lobe + ";\n";
  return text;
}

std::string source(const Row& row) {
  return gl::model_source([](const Entry&) { return true; }) +
         std::string(gl::shader_text("surface/angles.glsl")) +
         "layout(local_size_x = " + std::to_string(group_size) +
         ") in;\n"
         "layout(std430, binding = 0) readonly buffer Inputs { float input_of[]; };\n"
         "layout(std430, binding = 1) writeonly buffer Outputs { float output_of[]; };\n"
         "void main() {\n"
         "  uint at = gl_GlobalInvocationID.x * " +
         std::to_string(stride) +
         "u;\n"
         "  uint to = gl_GlobalInvocationID.x * " +
         std::to_string(lobe_count) + "u;\n" + body(row) + "}\n";
}

/// In the order of struct Angles.
std::vector<double> all_of(const models::Angles<double>& angles) {
  static_assert(sizeof angles == parameters_at * sizeof(double));
  std::vector<double> all(parameters_at);
  std::memcpy(all.data(), &angles, sizeof angles);
  return all;
}

void fill(float* to, const Row& row) {
  const auto copy = [](const std::vector<double>& from, float* where) {
    std::transform(from.begin(), from.end(), where, [](double x) { return static_cast<float>(x); });
  };
  copy(row.kind == "fresnel" || row.kind == "ripples" || row.from_vectors ? row.inputs
                                                                          : all_of(angles(row)),
       to);
  copy(row.parameters, to + parameters_at);
  to += parts_at;
  const auto add_part = [&](Kind kind, const std::string& text) {
    const Part one = part(text);
    *to = static_cast<float>(index_of(kind, one.name));
    copy(one.parameters, to + 1);
    to += part_size;
  };
  add_part(Kind::diffuse, row.diffuse);
  add_part(Kind::slope, row.slope);
  add_part(Kind::attenuation, row.attenuation);
}

}  // namespace

Result<GlBuild> GlBuild::create() {
  setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);  // Or the cache lands in $HOME.
  auto context = gl::Context::create();
  if (!context) return tl::unexpected(context.error());
  return GlBuild(std::move(*context));
}

Result<const gl::Compute*> GlBuild::program(const Row& row) {
  const std::string name = row.kind + "/" + row.form + (row.from_vectors ? " of vectors" : "");
  auto found = programs_.find(name);
  if (found == programs_.end()) {
    auto compiled = gl::Compute::compile(source(row));
    if (!compiled) return tl::unexpected(compiled.error());
    found = programs_.emplace(name, std::move(*compiled)).first;
  }
  return &found->second;
}

Result<Values> GlBuild::evaluate(const std::vector<Row>& rows) {
  Values values(rows.size());
  for (std::size_t begin = 0; begin < rows.size();) {
    // Take the rows of one form, which follow each other.
    std::size_t end = begin;
    while (end < rows.size() && rows[end].form == rows[begin].form) ++end;
    const std::size_t groups = (end - begin + group_size - 1) / group_size;
    std::vector<float> inputs(groups * group_size * stride);
    for (std::size_t i = begin; i < end; ++i) fill(&inputs[(i - begin) * stride], rows[i]);

    // Run them, and keep what those with f32 inputs give.
    const auto compute = program(rows[begin]);
    if (!compute) return tl::unexpected(compute.error());
    const auto outputs =
        (*compute)->run(inputs, groups * group_size * lobe_count, static_cast<unsigned>(groups));
    if (!outputs) return tl::unexpected(outputs.error());
    for (std::size_t i = begin; i < end; ++i) {
      const float* from = outputs->data() + (i - begin) * lobe_count;
      if (rows[i].single) values[i].assign(from, from + rows[i].values.size());
    }
    begin = end;
  }
  return values;
}

}  // namespace metamer::extremes
