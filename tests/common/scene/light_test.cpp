// What a scene may say of a light: the schema, the ranges and the messages follow lights.def.

#include "common/scene/light.h"

#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include "scene_text.h"

namespace metamer::test {
namespace {

using lights::Entry, lights::Parameter;
using Kind = lights::Parameter::Kind;

bool is_vector(const Parameter& one) { return lights::value_count(one.kind) == 3; }

TEST(SceneLight, TheSchemaHasTheFieldsOfTheTable) {
  const auto& where = *v1::Light::descriptor()->FindOneofByName("where");
  // And an environment, which is a picture, and objects that shine.
  EXPECT_EQ(static_cast<std::size_t>(where.field_count()), lights::registry().size() + 2);
  for (const Entry& entry : lights::registry()) {
    const auto* member = v1::Light::descriptor()->FindFieldByNumber(entry.number);
    ASSERT_TRUE(member != nullptr && member->containing_oneof() == &where) << entry.name;
    const auto& message = *member->message_type();
    if (entry.parameters.size() == 1 && is_vector(entry.parameters[0])) {
      EXPECT_STREQ(member->name().c_str(), entry.parameters[0].name);
      EXPECT_EQ(&message, v1::Vec3::descriptor());
      continue;
    }
    EXPECT_STREQ(member->name().c_str(), entry.name);
    EXPECT_STREQ(message.name().c_str(), entry.type);
    ASSERT_EQ(static_cast<std::size_t>(message.field_count()), entry.parameters.size());
    for (int i = 0; i < message.field_count(); ++i) {
      const Parameter& parameter = entry.parameters[static_cast<std::size_t>(i)];
      EXPECT_STREQ(message.field(i)->name().c_str(), parameter.name);
      EXPECT_EQ(message.field(i)->number(), i + 1);
      EXPECT_EQ(message.field(i)->message_type() == v1::Vec3::descriptor(), is_vector(parameter));
    }
  }
}

TEST(SceneLight, OldFilesAndOldBytesAreLights) {
  // Field 2 or 3, a Vec3 of nine bytes: its field 1, the double 1.
  const std::string vector("\x09\x09\0\0\0\0\0\0\xf0\x3f", 10);
  v1::Light light;
  ASSERT_TRUE(light.ParseFromString("\x12" + vector));
  EXPECT_EQ(light.position().x(), 1);
  EXPECT_STREQ(chosen_light(light).entry->name, "point");
  ASSERT_TRUE(light.ParseFromString("\x1a" + vector));
  EXPECT_EQ(light.direction().x(), 1);
  EXPECT_STREQ(chosen_light(light).entry->name, "directional");
}

/// A light by a table's line with all directions along z, two sides, and more in its message.
std::string text_of(const Entry& entry, const std::string& more = "") {
  std::string own;
  for (const Parameter& one : entry.parameters)
    if (one.kind == Kind::direction)
      own += std::string(one.name) + " { z: -1 } ";
    else if (one.kind == Kind::vector)
      own += std::string(one.name) + (own.empty() ? " { x: 1 } " : " { x: 1 y: 2 } ");
  return std::string("light { ") + entry.name + " { " + own + more +
         " } spectrum { constant: 1 } }\n";
}

TEST(SceneLight, EveryParametersEndsAreAllowedAndWhatLiesBeyondNamesTheNearest) {
  for (const Entry& entry : lights::registry())
    for (const Parameter& one : entry.parameters) {
      if (is_vector(one) || one.kind == Kind::length) continue;
      const auto with = [&](double value) {
        return findings(
            {.light = text_of(entry, std::string(one.name) + ": " + number_text(value))});
      };
      EXPECT_EQ(with(one.min), Strings()) << one.name;
      EXPECT_EQ(with(one.default_value), Strings()) << one.name;
      EXPECT_EQ(with(one.max), Strings()) << one.name;
      for (const auto& [beyond, nearest] :
           {std::pair{one.min - 0.0625, one.min}, {one.max + 0.0625, one.max}})
        EXPECT_EQ(with(beyond),
                  Strings({std::string("light[0].") + entry.name + "." + one.name + ": " +
                           one.name + " must lie in " + number_text(one.min) + ".." +
                           number_text(one.max) + " (it is " + number_text(beyond) +
                           "); the nearest allowed value is " + number_text(nearest)}));
    }
}

TEST(SceneLight, ASpotNeedsADirection) {
  EXPECT_EQ(findings({.light = "light { spot { position { y: 1 } } spectrum { constant: 1 } }"}),
            Strings({"light[0].spot.direction: direction must not be 0"}));
  // Of any other length.
  EXPECT_EQ(findings({.light = "light { spot { direction { z: 1e-15 } } spectrum { constant: 1 } "
                               "reference_distance: 2 }"}),
            Strings());
}

std::string surface(const std::string& light, const std::string& more = "") {
  return "light { " + light + " spectrum { constant: 1 } " + more + " }";
}

TEST(SceneLight, ASurfaceOfNoAreaIsNoLight) {
  EXPECT_EQ(findings({.light = surface("quad { u { x: 1 } }")}),
            Strings({"light[0].quad.v: v must not be 0"}));
  EXPECT_EQ(findings({.light = surface("quad { u { x: 1 } v { x: -2 } }")}),
            Strings({"light[0].quad.v: v must not be parallel to u"}));
  EXPECT_EQ(findings({.light = surface("disk { normal { y: 1 } radius: 0 }")}),
            Strings({"light[0].disk.radius: radius must be above 0 (it is 0)"}));
  EXPECT_EQ(findings({.light = surface("sphere { radius: -1 }")}),
            Strings({"light[0].sphere.radius: radius must be above 0 (it is -1)"}));
  EXPECT_EQ(findings({.light = surface("sphere { radius: 2 }", "reference_distance: 2")}),
            Strings({"light[0].reference_distance: reference_distance must be more than the "
                     "sphere's radius"}));
}

TEST(SceneLight, WhatALightCanNotHaveIsTold) {
  EXPECT_EQ(findings({.light = surface("sphere {}", "solid_angle: 1")}),
            Strings({"light[0].solid_angle: a light with a surface has a solid angle of its own: "
                     "leave solid_angle out"}));
  EXPECT_EQ(findings({.light = surface("position { y: 1 }", "visible: false")}),
            Strings({"light[0].visible: visible is for lights with a surface and for environments: "
                     "a point light is never seen"}));
  EXPECT_EQ(findings({.light = surface("environment {}", "reference_distance: 1")}),
            Strings({"light[0].reference_distance: reference_distance is for lights with a "
                     "position"}));
  EXPECT_EQ(findings({.light = surface("environment { file: 'sky.jpg' }")}),
            Strings({"light[0].environment.file: file must end in .exr (it is \"sky.jpg\")"}));
  EXPECT_EQ(findings({.light = surface("environment {}") + surface("environment {}")}),
            Strings({"light[1]: a scene has one environment (the first is light[0])"}));
  EXPECT_EQ(findings({.light = surface("environment {}", "visible: false")}), Strings());
}

}  // namespace
}  // namespace metamer::test
