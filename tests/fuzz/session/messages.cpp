#include "messages.h"

#include <iterator>
#include <limits>

namespace metamer::fuzz {

namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr int deepest = 5;

std::uint64_t any_number(Bytes& bytes, const Facts& facts) {
  switch (bytes.pick(8)) {
    case 0:
    case 1:
    case 2:
      if (facts.owners.empty()) return 1;
      return std::next(facts.owners.begin(),
                       static_cast<std::ptrdiff_t>(bytes.pick(facts.owners.size())))
          ->first;
    case 3:
      return facts.views.empty() ? 1 : facts.views[bytes.pick(facts.views.size())];
    case 4:
      return bytes.number();
    case 5:
      return std::numeric_limits<std::uint64_t>::max() - bytes.pick(2);
    case 6:
      return std::uint64_t{1} << bytes.pick(64);
    default:
      return bytes.wide();
  }
}

std::string any_text(Bytes& bytes, const Facts& facts) {
  switch (bytes.pick(4)) {
    case 0:
    case 1:
      return digest_of(bytes.number());
    case 2:
      return facts.tokens.empty() ? "" : facts.tokens[bytes.pick(facts.tokens.size())];
    default:
      return bytes.take(bytes.number());
  }
}

void fill_to(Message& message, Bytes& bytes, const Facts& facts, int depth);

/// Sets a field, or adds to a repeated one.
void set(Message& message, const FieldDescriptor& field, Bytes& bytes, const Facts& facts,
         int depth) {
  const Reflection& of = *message.GetReflection();
  const auto put = [&](const auto& once, const auto& again, auto value) {
    field.is_repeated() ? (of.*again)(&message, &field, value)
                        : (of.*once)(&message, &field, value);
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return put(&Reflection::SetInt32, &Reflection::AddInt32,
                 static_cast<std::int32_t>(any_number(bytes, facts)));
    case FieldDescriptor::CPPTYPE_INT64:
      return put(&Reflection::SetInt64, &Reflection::AddInt64,
                 static_cast<std::int64_t>(any_number(bytes, facts)));
    case FieldDescriptor::CPPTYPE_UINT32:
      return put(&Reflection::SetUInt32, &Reflection::AddUInt32,
                 static_cast<std::uint32_t>(any_number(bytes, facts)));
    case FieldDescriptor::CPPTYPE_UINT64:
      return put(&Reflection::SetUInt64, &Reflection::AddUInt64, any_number(bytes, facts));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return put(&Reflection::SetDouble, &Reflection::AddDouble,
                 static_cast<double>(any_number(bytes, facts)));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return put(&Reflection::SetFloat, &Reflection::AddFloat,
                 static_cast<float>(any_number(bytes, facts)));
    case FieldDescriptor::CPPTYPE_BOOL:
      return put(&Reflection::SetBool, &Reflection::AddBool, bytes.flag());
    case FieldDescriptor::CPPTYPE_ENUM:
      return put(&Reflection::SetEnumValue, &Reflection::AddEnumValue, int{bytes.number()} - 1);
    case FieldDescriptor::CPPTYPE_STRING: {
      std::string text = any_text(bytes, facts);
      // What is no UTF-8 is no text, and the message not even parsed: raw frames have that.
      if (field.type() == FieldDescriptor::TYPE_STRING)
        for (char& c : text) c = static_cast<char>(c & 0x7f);
      return field.is_repeated() ? of.AddString(&message, &field, text)
                                 : of.SetString(&message, &field, text);
    }
    case FieldDescriptor::CPPTYPE_MESSAGE:
      if (depth == deepest) return;
      return fill_to(field.is_repeated() ? *of.AddMessage(&message, &field)
                                         : *of.MutableMessage(&message, &field),
                     bytes, facts, depth + 1);
  }
}

void fill_to(Message& message, Bytes& bytes, const Facts& facts, int depth) {
  const auto& fields = *message.GetDescriptor();
  if (fields.field_count() == 0) return;
  for (std::size_t left = bytes.pick(8); left > 0 && !bytes.empty(); --left) {
    const auto at = static_cast<int>(bytes.pick(std::size_t(fields.field_count())));
    set(message, *fields.field(at), bytes, facts, depth);
  }
}

}  // namespace

void fill(Message& message, Bytes& bytes, const Facts& facts) { fill_to(message, bytes, facts, 0); }

}  // namespace metamer::fuzz
