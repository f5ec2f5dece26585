#pragma once

#include "client/gui/document/text_file.h"
#include "client/gui/editor/providers.h"

namespace metamer::gui {

/// What the schema, and the scene itself, say to an editor of it. All is found on the thread pool;
/// answers come in the thread of `file`, unless it has gone.
EditorProviders scene_guide(TextFile* file);

/// A small scene to begin with.
QString new_scene_text();

}  // namespace metamer::gui
