#include "tests/extremes/table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

#include "common/models/reference.h"
#include "common/problem.h"

namespace metamer::extremes {
namespace {

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(by, begin)) != std::string::npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  if (begin < text.size()) parts.push_back(text.substr(begin));
  return parts;
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> result;
  for (const std::string& word : split(text, ' '))
    result.push_back(std::strtod(word.c_str(), nullptr));
  return result;
}

bool exact_in_f32(const std::vector<double>& values) {
  for (const double value : values) {
    if (static_cast<double>(static_cast<float>(value)) != value) return false;
  }
  return true;
}

const std::string vectors_folder = "vectors/";

std::vector<Row> read(const std::string& name) {
  // Order of the columns: see write() in truth.py.
  std::ifstream file(std::string(METAMER_TEST_DATA) + "/extremes/" + name + ".csv");
  const bool from_vectors = name.starts_with(vectors_folder);
  const std::string kind = from_vectors ? name.substr(vectors_folder.size()) : name;
  std::vector<Row> rows;
  std::string text;
  std::getline(file, text);
  EXPECT_EQ(text, "form,extremes,inputs,parameters,diffuse,slope,attenuation,values,peak") << name;
  for (int line = 2; std::getline(file, text); ++line) {
    const auto cells = split(text, ',');
    if (cells.size() != 9) {
      ADD_FAILURE() << name << ".csv:" << line << " has " << cells.size() << " cells";
      return {};
    }
    Row row{kind,
            cells[0],
            split(cells[1], '|'),
            from_vectors,
            numbers(cells[2]),
            numbers(cells[3]),
            cells[4],
            cells[5],
            cells[6],
            numbers(cells[7]),
            numbers(cells[8])[0],
            true,
            line};
    // Vectors are written by the digits that say which f32 number is meant.
    if (from_vectors)
      for (double& value : row.inputs) value = static_cast<float>(value);
    row.single = exact_in_f32(row.inputs) && exact_in_f32(row.parameters);
    for (const std::string& one : {row.diffuse, row.slope, row.attenuation})
      row.single = row.single && exact_in_f32(part(one).parameters);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

const std::vector<Row>& table(const std::string& file) {
  static std::map<std::string, std::vector<Row>> tables;
  const auto found = tables.find(file);
  return found != tables.end() ? found->second : tables.emplace(file, read(file)).first->second;
}

std::string where(const Row& row) {
  std::string text = (row.from_vectors ? vectors_folder : "") + row.kind +
                     ".csv:" + std::to_string(row.line) + " " + row.form + " (";
  for (const double value : row.inputs) text += number_text(value) + " ";
  text.back() = ';';
  for (const double value : row.parameters) text += " " + number_text(value);
  for (const std::string& one : {row.diffuse, row.slope, row.attenuation})
    if (!one.empty()) text += "; " + one;
  return text + ")";
}

Part part(const std::string& text) {
  const auto end = text.find(' ');
  if (end == std::string::npos) return {text, {}};
  return {text.substr(0, end), numbers(text.substr(end + 1))};
}

int index_of(models::Kind kind, const std::string& name) {
  for (const models::Entry& entry : models::registry(kind))
    if (entry.name == name) return entry.index;
  return -1;
}

models::Angles<double> angles(const Row& row) {
  const auto& a = row.inputs;
  if (row.from_vectors) {
    const auto unit = [&](std::size_t i) {
      return Eigen::Vector3d(a[i], a[i + 1], a[i + 2]).normalized();
    };
    const Eigen::Vector3d normal = unit(0), tangent = unit(3);
    const Eigen::Vector3d flat = (tangent - normal.dot(tangent) * normal).normalized();
    return models::angles_between(normal, flat, unit(6), unit(9), a[12]);
  }
  return {.n_dot_l = a[0],
          .n_dot_v = a[1],
          .n_dot_h = a[2],
          .v_dot_h = a[3],
          .r_dot_v = a[4],
          .n_l_versine = 1 - a[0],
          .n_v_versine = 1 - a[1],
          .n_h_versine = 1 - a[2],
          .r_v_versine = 1 - a[4],
          .azimuth = a[5],
          .tangent = a[6],
          .bitangent = 1 - a[6],
          .solid_angle = a[7]};
}

models::Reflection<double> reflection(const Row& row) {
  models::Reflection<double> result;
  result.model = static_cast<models::Model>(index_of(models::Kind::model, row.form));
  result.parameters = parameters(row.parameters);
  if (!row.diffuse.empty()) {
    const Part diffuse = part(row.diffuse);
    result.diffuse =
        static_cast<models::DiffuseTerm>(index_of(models::Kind::diffuse, diffuse.name));
    result.diffuse_parameters = parameters(diffuse.parameters);
  }
  if (!row.slope.empty()) {
    const Part slope = part(row.slope), attenuation = part(row.attenuation);
    result.slopes[0] = {static_cast<models::Slope>(index_of(models::Kind::slope, slope.name)), 1,
                        parameters(slope.parameters)};
    result.slope_count = 1;
    result.attenuation =
        static_cast<models::Attenuation>(index_of(models::Kind::attenuation, attenuation.name));
    result.roughness = attenuation.parameters[0];
  }
  return result;
}

models::Reflection<double>::Parameters parameters(const std::vector<double>& values) {
  models::Reflection<double>::Parameters result{};
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

models::Reflection<float>::Parameters single(const models::Reflection<double>::Parameters& from) {
  models::Reflection<float>::Parameters to{};
  std::transform(from.begin(), from.end(), to.begin(),
                 [](double value) { return static_cast<float>(value); });
  return to;
}

models::Reflection<float> single(const models::Reflection<double>& from) {
  models::Reflection<float> to;
  to.model = from.model;
  to.parameters = single(from.parameters);
  to.diffuse = from.diffuse;
  to.diffuse_parameters = single(from.diffuse_parameters);
  to.slope_count = from.slope_count;
  for (std::size_t i = 0; i < from.slope_count; ++i)
    to.slopes[i] = {from.slopes[i].slope, static_cast<float>(from.slopes[i].weight),
                    single(from.slopes[i].parameters)};
  to.attenuation = from.attenuation;
  to.roughness = static_cast<float>(from.roughness);
  return to;
}

}  // namespace metamer::extremes
