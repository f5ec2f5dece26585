#include "common/mesh/gltf/accessor.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "common/scene/limits.h"

namespace metamer::gltf {
namespace {

using Type = Accessor::Type;

std::size_t size_of(Type type) {
  switch (type) {
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::u32:
    case Type::f32:
      return 4;
  }
  return 0;
}

std::optional<Type> type_of(const Value& value) {
  const std::uint64_t code = value.whole(0xFFFF);
  for (const Type type : {Type::i8, Type::u8, Type::i16, Type::u16, Type::u32, Type::f32})
    if (code == static_cast<std::uint64_t>(type)) return type;
  value.fault("is no type of numbers");
  return std::nullopt;
}

/// Both are little-endian: glTF and all that Metamer runs on.
template <class T>
T read(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

double read_number(const char* from, Type type, bool normalized) {
  const auto scaled = [&](double value, double most) {
    return normalized ? std::max(value / most, -1.0) : value;
  };
  switch (type) {
    case Type::i8:
      return scaled(read<std::int8_t>(from), 127);
    case Type::u8:
      return scaled(read<std::uint8_t>(from), 255);
    case Type::i16:
      return scaled(read<std::int16_t>(from), 32767);
    case Type::u16:
      return scaled(read<std::uint16_t>(from), 65535);
    case Type::u32:
      return scaled(read<std::uint32_t>(from), 4294967295.0);
    case Type::f32:
      return static_cast<double>(read<float>(from));
  }
  return 0;
}

std::uint32_t read_whole(const char* from, Type type) {
  switch (type) {
    case Type::u8:
      return read<std::uint8_t>(from);
    case Type::u16:
      return read<std::uint16_t>(from);
    case Type::u32:
      return read<std::uint32_t>(from);
    case Type::i8:
    case Type::i16:
    case Type::f32:
      break;
  }
  return 0;
}

constexpr std::uint64_t most_elements = 3 * limits::max_triangles;
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 40;

/// The bytes of a view from `offset` on, as many as `count` elements of `size` bytes take.
std::span<const char> bytes_of(Document& document, const Value& index, std::uint64_t offset,
                               std::uint64_t count, std::size_t size, std::size_t* stride_out) {
  const Value views = document.root()["bufferViews"];
  const auto which = index.index(views.size());
  if (!which) {
    index.fault("is missing");
    return {};
  }
  const Value view = views[*which];
  const std::uint64_t stride = view["byteStride"].whole(252, size);
  const std::uint64_t begin = view["byteOffset"].whole(most_bytes, 0);
  const std::uint64_t length = view["byteLength"].whole(most_bytes);
  if (stride < size) {
    view["byteStride"].fault("is shorter than an element");
    return {};
  }
  const std::uint64_t wanted = count == 0 ? 0 : (count - 1) * stride + size;
  if (offset > length || wanted > length - offset) {
    view.fault("has " + std::to_string(length) + " bytes; " + std::to_string(wanted) +
               " are wanted from " + std::to_string(offset) + " on");
    return {};
  }
  if (stride_out != nullptr) *stride_out = stride;
  return document.bytes(view["buffer"], begin + offset, wanted);
}

}  // namespace

std::optional<Accessor> Accessor::open(Document& document, const Value& index,
                                       std::initializer_list<std::string_view> types) {
  const Value list = document.root()["accessors"];
  const auto which = index.index(list.size());
  if (!which) return std::nullopt;
  const Value accessor = list[*which];
  const std::string type = accessor["type"].text();
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    accessor["type"].fault("is not what " + index.place() + " needs");
    return std::nullopt;
  }
  Accessor result;
  static constexpr std::array<std::pair<std::string_view, std::size_t>, 4> lengths = {
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}}};
  for (const auto& [word, length] : lengths)
    if (type == word) result.components_ = length;
  const auto numbers = type_of(accessor["componentType"]);
  if (!numbers) return std::nullopt;
  result.type_ = *numbers;
  result.normalized_ = accessor["normalized"].flag();
  result.count_ = accessor["count"].whole(most_elements);
  const Value sparse = accessor["sparse"];
  if (!result.open_dense(document, accessor) || (sparse && !result.open_sparse(document, sparse)))
    return std::nullopt;
  return result;
}

bool Accessor::open_dense(Document& document, const Value& accessor) {
  const Value view = accessor["bufferView"];
  if (!view) {  // All 0.
    if (count_ > document.most_zeros())
      accessor["count"].fault("is more than a file of its size may name without a bufferView");
    return count_ <= document.most_zeros();
  }
  const auto bytes = bytes_of(document, view, accessor["byteOffset"].whole(most_bytes, 0), count_,
                              components_ * size_of(type_), &stride_);
  data_ = bytes.data();
  return data_ != nullptr || count_ == 0;
}

bool Accessor::open_sparse(Document& document, const Value& sparse) {
  const std::uint64_t count = sparse["count"].whole(count_);
  const Value indices = sparse["indices"], values = sparse["values"];
  const auto type = type_of(indices["componentType"]);
  if (!type || count == 0) return type.has_value();
  const std::size_t size = components_ * size_of(type_);
  std::size_t step = 0, stride = 0;
  const auto places =
      bytes_of(document, indices["bufferView"], indices["byteOffset"].whole(most_bytes, 0), count,
               size_of(*type), &step);
  const auto numbers = bytes_of(document, values["bufferView"],
                                values["byteOffset"].whole(most_bytes, 0), count, size, &stride);
  if (places.empty() || numbers.empty()) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint32_t at = read_whole(places.data() + i * step, *type);
    if (at >= count_ || (!sparse_.empty() && at <= sparse_.back().index)) {
      indices.fault("must rise and stay below " + std::to_string(count_));
      return false;
    }
    sparse_.push_back({at, numbers.data() + i * stride});
  }
  return true;
}

const char* Accessor::element(std::size_t i) const {
  if (!sparse_.empty()) {
    const auto found =
        std::lower_bound(sparse_.begin(), sparse_.end(), i,
                         [](const Sparse& one, std::size_t index) { return one.index < index; });
    if (found != sparse_.end() && found->index == i) return found->value;
  }
  return data_ == nullptr ? nullptr : data_ + i * stride_;
}

double Accessor::number(std::size_t i, std::size_t c) const {
  const char* const from = element(i);
  return from == nullptr ? 0 : read_number(from + c * size_of(type_), type_, normalized_);
}

std::uint32_t Accessor::whole(std::size_t i) const {
  const char* const from = element(i);
  return from == nullptr ? 0 : read_whole(from, type_);
}

}  // namespace metamer::gltf
