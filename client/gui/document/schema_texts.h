#pragma once

#include <QByteArray>
#include <QString>

#include "client/tools/scene/schema_help.h"

namespace metamer::gui {

/// A file of the program's resources: "schema.pb"; empty: it can't be read.
QByteArray resource(const QString& name);

/// What the schema in this program says of its fields; null: it can't be read. Read once, by
/// whoever needs it first; from any thread.
const client::SchemaHelp* schema_help();

/// As a tool tip, which wraps: the signature, and a paragraph each.
QString help_tip(const client::FieldHelp& help);

}  // namespace metamer::gui
