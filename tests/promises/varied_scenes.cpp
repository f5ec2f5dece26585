#include "tests/promises/varied_scenes.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "tests/server/methods/lamps.h"

namespace metamer::promises {
namespace {

/// Draws what the standard library's distributions would draw differently elsewhere.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967295.0;
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }

 private:
  std::mt19937 engine_;
};

std::string print(const char* format, auto... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string samples(double from, double to, double step,
                    const std::function<double(double)>& value) {
  std::string nm, values;
  for (double at = from; at <= to; at += step) {
    nm += print("%s%g", nm.empty() ? "" : ",", at);
    values += print("%s%.6f", values.empty() ? "" : ",", value(at));
  }
  return "samples { wavelength: [" + nm + "] value: [" + values + "] }";
}

double bell(double nm, double center, double width) {
  return std::exp(-(nm - center) * (nm - center) / (2 * width * width));
}

struct Drawn {
  std::string name, text;
};

Drawn draw_light(Draw& draw) {
  static const char* const standard[] = {"A",  "D50", "D65", "E",   "F2",
                                         "F3", "F7",  "F8",  "F11", "F12"};
  switch (draw.below(5)) {
    case 0: {  // a white LED: a blue line and a broad phosphor
      const double blue = draw.between(440, 460), phosphor = draw.between(540, 600);
      return {"LED", samples(380, 780, 5, [=](double nm) {
                return 0.8 * bell(nm, blue, 9) + bell(nm, phosphor, 55);
              })};
    }
    case 1: {  // three narrow lines, which a coarse sampling steps over
      double center[3];
      for (int i = 0; i < 3; ++i) center[i] = draw.between(430 + 80 * i, 480 + 80 * i);
      const double width = draw.between(1, 4);
      return {"lines", samples(380, 780, 1, [=](double nm) {
                return 0.002 + bell(nm, center[0], width) + bell(nm, center[1], width) +
                       bell(nm, center[2], width);
              })};
    }
    default: {
      const char* name = standard[draw.below(10)];
      return {name, print("standard: \"%s\"", name)};
    }
  }
}

/// So many lines of `narrow` to `wide` nm (full width at half maximum), rising, 8 nm apart or more.
std::vector<test::GaussianLine> draw_lines(Draw& draw, std::uint32_t count, double narrow,
                                           double wide) {
  std::vector<test::GaussianLine> lines;
  const double room = 250.0 / count;
  for (std::uint32_t i = 0; i < count; ++i)
    lines.push_back({draw.between(410 + i * room, 402 + (i + 1) * room),
                     draw.between(narrow, wide) / 2.355, draw.between(1, 10)});
  return lines;
}

Drawn draw_narrow_light(Draw& draw) {
  const auto lamp = [](const char* name, double step, double continuum,
                       std::vector<test::GaussianLine> lines) {
    return Drawn{name, test::text_of(test::samples_of({name, step, continuum, std::move(lines)}))};
  };
  switch (draw.below(5)) {
    case 0:
      return lamp("lasers", 0, 0, draw_lines(draw, 2 + draw.below(3), 0.05, 0.2));
    case 1:
      return lamp("discharge", 0, draw.between(0, 0.3),
                  draw_lines(draw, 4 + draw.below(6), 0.05, 1));
    case 2: {
      const test::GaussianLine laser{draw.between(440, 465), draw.between(0.05, 0.5) / 2.355, 20};
      return lamp("laser phosphor", 0, 0, {laser, {draw.between(540, 590), 50, 60}});
    }
    case 3: {  // with little else: a single line shows every surface in one colour
      const double nm = draw.between(480, 620);
      return {"line", print("samples { wavelength: %.2f value: 1 }", nm)};
    }
    default: {
      const double step = draw.between(0, 1) < 0.5 ? 0.1 : 0.5;
      return lamp("even grid", step, 0.01,
                  draw_lines(draw, 3 + draw.below(4), 3 * step, 1 + 2 * step));
    }
  }
}

std::string draw_reflectance(Draw& draw) {
  const double low = draw.between(0.02, 0.2), high = draw.between(0.4, 0.95);
  const double center = draw.between(430, 650);
  switch (draw.below(4)) {
    case 0:  // a dye's edge
      return samples(380, 780, 5, [=](double nm) {
        return low + (high - low) / (1 + std::exp((center - nm) / 8));
      });
    case 1: {  // a narrow band
      const double width = draw.between(8, 25);
      return samples(380, 780, 4,
                     [=](double nm) { return low + (high - low) * bell(nm, center, width); });
    }
    case 2:  // a smooth hump
      return samples(380, 780, 10,
                     [=](double nm) { return low + (high - low) * bell(nm, center, 60); });
    default:  // near grey
      return samples(380, 780, 20,
                     [=](double nm) { return 0.45 + 0.1 * std::sin((nm - center) / 60); });
  }
}

std::string draw_model(Draw& draw) {
  static const char* const metals[] = {"Au", "Ag", "Cu", "Al"};
  switch (draw.below(6)) {
    case 0:
      return "";
    case 1:
      return print("diffuseness: 0.8 specularness: 0.3 blinn_phong { shininess: %g }",
                   draw.between(10, 200));
    case 2:
      return print(
          "diffuseness: 0.8 specularness: 0.3 phong { shininess: %g } fresnel { dielectric "
          "{ medium: \"N-BK7\" } }",
          draw.between(10, 100));
    case 3:
      return print(
          "diffuseness: 0.1 specularness: 0.9 cook_torrance {} slope { beckmann {} } fresnel "
          "{ conductor { metal: \"%s\" } }",
          metals[draw.below(4)]);
    case 4:
      return print("diffuseness: 0.6 specularness: 0.2 mirror: %g blinn_phong {}",
                   draw.between(0.1, 0.8));
    default:
      return print(
          "diffuseness: 0.3 specularness: 0.6 mirror: %g hall_greenberg {} fresnel { schlick {} }",
          draw.between(0.2, 0.9));
  }
}

VariedScene draw_scene(std::uint32_t seed, std::uint32_t side, std::uint32_t spp, bool narrow) {
  Draw draw(seed);
  const std::uint32_t lights = 1 + draw.below(3), materials = 3 + draw.below(6);
  const std::uint32_t depth = draw.below(5);
  std::string text = print(
      "camera { eye { y: 1.2 z: 6 } target { y: 0.6 } }\n"
      "settings { width: %u height: %u spp: %u depth: %u threads: 1 }\n",
      side, side * 3 / 4, spp, depth);
  std::string names;
  for (std::uint32_t i = 0; i < lights; ++i) {
    const bool lines = narrow && (i == 0 || draw.below(2) == 0);
    const Drawn light = lines ? draw_narrow_light(draw) : draw_light(draw);
    names += (names.empty() ? "" : ", ") + light.name;
    text += print("light { name: \"l%u\" position { x: %g y: %g z: %g } luminance: %g spectrum { ",
                  i, draw.between(-3, 3), draw.between(2.5, 4), draw.between(1, 5),
                  draw.between(0.3, 0.9) / lights) +
            light.text + " } }\n";
  }
  text += "material { name: \"floor\" diffuse { constant: 0.5 } }\n";
  text +=
      "object { name: \"floor\" material: \"floor\" quad { corner { x: -6 z: 4 } u { x: 12 } v { "
      "z: -10 } } }\n";
  for (std::uint32_t i = 0; i < materials; ++i) {
    text += print("material { name: \"m%u\" diffuse { ", i) + draw_reflectance(draw) + " } " +
            draw_model(draw) + " }\n";
    text += print(
        "object { name: \"o%u\" material: \"m%u\" sphere { center { x: %g y: %g z: %g } "
        "radius: %g } }\n",
        i, i, draw.between(-2, 2), draw.between(0.4, 1.2), draw.between(-2, 2),
        draw.between(0.25, 0.7));
  }
  return {print("%u light%s (%s), %u materials, depth %u", lights, lights == 1 ? "" : "s",
                names.c_str(), materials + 1, depth),
          text};
}

}  // namespace

std::vector<VariedScene> varied_scenes(std::uint32_t count, std::uint32_t side, std::uint32_t spp) {
  std::vector<VariedScene> scenes;
  for (std::uint32_t i = 0; i < count; ++i)
    scenes.push_back(draw_scene(1000 + i, side, spp, false));
  return scenes;
}

std::vector<VariedScene> narrow_scenes(std::uint32_t count, std::uint32_t side, std::uint32_t spp) {
  std::vector<VariedScene> scenes;
  for (std::uint32_t i = 0; i < count; ++i) scenes.push_back(draw_scene(5000 + i, side, spp, true));
  return scenes;
}

}  // namespace metamer::promises
