#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace metamer::gltf {

/// What is wrong with a document: the first thing that was found.
class Faults {
 public:
  void add(const std::string& place, const std::string& message) {
    if (!first_) first_ = place + " " + message;
  }
  const std::optional<std::string>& first() const { return first_; }

 private:
  std::optional<std::string> first_;
};

/// A value of a document and its place there: "meshes[2].primitives[0].mode". What is read of it is
/// of the kind that is asked for, or it is a fault and the answer is what a missing one gives.
class Value {
 public:
  Value(const nlohmann::json* value, std::string place, Faults& faults)
      : value_(value), place_(std::move(place)), faults_(&faults) {}

  /// Whether the document has it.
  explicit operator bool() const { return value_ != nullptr; }
  const std::string& place() const { return place_; }
  void fault(const std::string& message) const { faults_->add(place_, message); }

  /// A member of an object.
  Value operator[](const char* name) const;
  /// Of a list: its length, 0 for a missing one, and its elements.
  std::size_t size() const;
  Value operator[](std::size_t i) const;

  /// A number that must be there, and one that need not.
  std::uint64_t whole(std::uint64_t most) const;
  std::uint64_t whole(std::uint64_t most, std::uint64_t otherwise) const;
  /// The index of an element of a list of so many; nothing: it is missing or a fault.
  std::optional<std::size_t> index(std::size_t count) const;
  /// Finite.
  double number(double otherwise) const;
  /// As many numbers as a list must have; nothing: it is missing or a fault.
  std::optional<std::vector<double>> numbers(std::size_t count) const;
  bool flag() const;
  std::string text() const;  ///< UTF-8.

 private:
  const nlohmann::json* value_;
  std::string place_;
  Faults* faults_;
};

}  // namespace metamer::gltf
