#pragma once

#include <string>

#include "client/tools/scene/look.h"

/// A look as a window changes it, a control after the other.
namespace metamer::client {

/// The scene's look of that name takes the place of the one before it, and of what was changed by
/// hand of the same kind: the lights, where it names any; each material that it names; observer,
/// development and camera, where it says them. Other changes by hand stay, and all of settings that
/// no look has. So which looks came before does not matter. Error: that of look_named.
Result<Look> choose_look(const Look& now, const v1::Scene& scene, const std::string& name);

/// Without all that looks are made of: the scene's own lights, paints, observer, development and
/// camera.
Look without_look(const Look& now);

/// By hand: takes the place of what the look said of the same thing.
void set_light(const v1::LookLight& to, Look& look);
void set_material(const v1::LookMaterial& to, Look& look);
/// `path` as a mask has it, "development.adaptation"; `settings` has the value.
void set_setting(const std::string& path, const v1::Settings& settings, Look& look);
/// One of the CIE's, also in place of a file.
void set_observer(v1::Observer observer, Look& look);

/// The method, or the goal in its place, that `wanted` has, whatever the scene's `own` settings
/// say; its other settings do not matter.
void set_method(const v1::Settings& own, const v1::Settings& wanted, Look& look);

/// What a scene file keeps of it; settings that no look has are left out.
v1::Look to_message(const Look& look, const std::string& name);

/// A scene without its objects: what looks change, and the looks.
v1::Scene without_objects(const v1::Scene& scene);
/// Whether two looks make the same of a scene; false where one of them does not fit it.
bool look_alike(const Look& one, const Look& other, const v1::Scene& scene);

/// D65, A and F11 for all lights, as looks: for a scene that has none.
void add_standard_looks(v1::Scene& scene);

}  // namespace metamer::client
