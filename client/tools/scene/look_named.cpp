#include "client/tools/scene/look.h"
#include "common/scene/schema.h"

namespace metamer::client {
namespace {

/// Collects what one look of a scene says.
class LookReader {
 public:
  LookReader(const v1::Look& message, std::string field)
      : message_(message), field_(std::move(field)), by_("look " + quoted(message.name())) {}

  Look read() {
    for (int i = 0; i < message_.light_size(); ++i)
      look_.lights.push_back({.light = message_.light(i),
                              .by = by_,
                              .from = field_ + ".light[" + std::to_string(i) + "]"});
    for (int i = 0; i < message_.material_size(); ++i)
      look_.materials.push_back({.material = message_.material(i),
                                 .by = by_,
                                 .from = field_ + ".material[" + std::to_string(i) + "]"});
    observer();
    development();
    if (message_.has_camera()) {
      look_.camera = message_.camera();
      look_.replaced.push_back({"camera", by_, {}, field_ + ".camera"});
    }
    return std::move(look_);
  }

 private:
  /// Says that settings.<path> counts, and where the look says it.
  void set(const std::string& path, const std::string& member) {
    look_.set(path, by_);
    look_.replaced.back().from = field_ + "." + member;
  }

  /// One of the CIE's and a file exclude each other.
  void observer() {
    if (!message_.has_observer() && message_.observer_file().empty()) return;
    look_.settings.set_observer(message_.observer());
    look_.settings.set_observer_file(message_.observer_file());
    const bool file = !message_.observer_file().empty();
    set("observer", file ? "observer_file" : "observer");
    set("observer_file", file ? "observer_file" : "observer");
  }

  void development() {
    const v1::Development& from = message_.development();
    *look_.settings.mutable_development() = from;
    const auto take = [&](const std::string& member) {
      set("development." + member, "development." + member);
    };
    if (from.has_adaptation()) take("adaptation");
    if (from.has_rgb_space()) take("rgb_space");
    if (from.has_primaries())
      for (const std::string& member : field_names(*v1::Primaries::descriptor()))
        take("primaries." + member);
    if (from.linear()) take("linear");
    if (from.has_exposure()) take("exposure");
    if (from.has_white_luminance()) take("white_luminance");
  }

  const v1::Look& message_;
  std::string field_;
  std::string by_;
  Look look_;
};

}  // namespace

Result<Look> look_named(const v1::Scene& scene, const std::string& name) {
  constexpr int max_listed = 20;
  std::vector<std::string> names;
  std::string listed;
  for (int i = 0; i < scene.look_size(); ++i) {
    const std::string& one = scene.look(i).name();
    if (one == name) return LookReader(scene.look(i), "look[" + std::to_string(i) + "]").read();
    names.push_back(one);
    if (i < max_listed) listed += (i == 0 ? "" : ", ") + quoted(one);
  }
  if (scene.look_size() > max_listed) listed += ", …";
  if (names.empty()) return problem("the scene has no looks, so none named " + quoted(name));
  Problem unknown = metamer::unknown_name("no look named " + quoted(name), name, names);
  if (unknown.meant.empty()) unknown.message += "; there are " + listed;
  return tl::unexpected(std::move(unknown));
}

}  // namespace metamer::client
