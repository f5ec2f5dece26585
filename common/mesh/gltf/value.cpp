#include "common/mesh/gltf/value.h"

#include <cmath>

namespace metamer::gltf {

using nlohmann::json;

Value Value::operator[](const char* name) const {
  const auto missing = [&] { return Value(nullptr, place_ + "." + name, *faults_); };
  if (value_ == nullptr) return missing();
  if (!value_->is_object()) {
    fault("is not an object");
    return missing();
  }
  const auto found = value_->find(name);
  if (found == value_->end()) return missing();
  return {&*found, place_.empty() ? name : place_ + "." + name, *faults_};
}

std::size_t Value::size() const {
  if (value_ == nullptr) return 0;
  if (value_->is_array()) return value_->size();
  fault("is not a list");
  return 0;
}

Value Value::operator[](std::size_t i) const {
  return {value_ != nullptr && value_->is_array() && i < value_->size() ? &(*value_)[i] : nullptr,
          place_ + "[" + std::to_string(i) + "]", *faults_};
}

std::uint64_t Value::whole(std::uint64_t most) const {
  if (value_ == nullptr) fault("is missing");
  return whole(most, 0);
}

std::uint64_t Value::whole(std::uint64_t most, std::uint64_t otherwise) const {
  if (value_ == nullptr) return otherwise;
  double number = value_->is_number() ? value_->get<double>() : -1;
  if (number >= 0 && number <= static_cast<double>(most) && number == std::floor(number))
    return static_cast<std::uint64_t>(number);
  fault("must be a whole number from 0 to " + std::to_string(most));
  return otherwise;
}

std::optional<std::size_t> Value::index(std::size_t count) const {
  if (value_ == nullptr) return std::nullopt;
  if (count == 0) {
    fault("names one of a list that is empty");
    return std::nullopt;
  }
  const std::uint64_t at = whole(count - 1, count);
  return at < count ? std::optional<std::size_t>(at) : std::nullopt;
}

double Value::number(double otherwise) const {
  if (value_ == nullptr) return otherwise;
  const double number = value_->is_number() ? value_->get<double>() : std::nan("");
  if (std::isfinite(number)) return number;
  fault("must be a number");
  return otherwise;
}

std::optional<std::vector<double>> Value::numbers(std::size_t count) const {
  if (value_ == nullptr) return std::nullopt;
  if (size() != count) {
    fault("must have " + std::to_string(count) + " numbers");
    return std::nullopt;
  }
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back((*this)[i].number(0));
  return list;
}

bool Value::flag() const {
  if (value_ == nullptr) return false;
  if (!value_->is_boolean()) fault("must be true or false");
  return value_->is_boolean() && value_->get<bool>();
}

std::string Value::text() const {
  if (value_ == nullptr) return {};
  if (!value_->is_string()) {
    fault("must be a text");
    return {};
  }
  return value_->get<std::string>();
}

}  // namespace metamer::gltf
