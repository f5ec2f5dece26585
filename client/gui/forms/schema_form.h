#pragma once

#include <google/protobuf/message.h>

#include <QComboBox>
#include <QFormLayout>
#include <QWidget>
#include <functional>
#include <map>
#include <vector>

#include "client/gui/forms/field_editors.h"

namespace metamer::gui {

/// A form of a message, made from its descriptor: a row for each field, messages in boxes of their
/// own, of a oneof a list and what belongs to its chosen member. A new field of the schema is a new
/// row.
class SchemaForm : public QWidget {
  Q_OBJECT
 public:
  using Facts = std::function<FieldFacts(const std::string& path)>;
  /// Whether a field has a row; those that have none keep what show() was given.
  using Wanted = std::function<bool(const std::string& path)>;

  /// `path` is the message's own, "" of the root; it begins all paths here.
  SchemaForm(const google::protobuf::Descriptor& type, std::string path, const Facts& facts,
             const Wanted& wanted, QWidget* parent = nullptr);

  void show_message(const google::protobuf::Message& message);
  /// Puts what is shown into `message`. A message in it whose rows are all left out is cleared.
  void store(google::protobuf::Message& message) const;

  /// What edits a field, or the list of a oneof by its own name: "spp", "method.point.step",
  /// "method.method"; null: there is none.
  QWidget* editor(const std::string& path) const;
  std::vector<std::string> paths() const;

 Q_SIGNALS:
  /// By hand.
  void changed(const QString& path);

 private:
  using Field = google::protobuf::FieldDescriptor;
  struct Row {
    const Field* field;
    FieldEditor editor;          ///< Of a field that is no message.
    SchemaForm* form = nullptr;  ///< Of a message.
    QWidget* widget() const { return form != nullptr ? form : editor.widget; }
  };
  /// The list of a oneof: its data are numbers of fields, 0: none.
  struct Choice {
    const google::protobuf::OneofDescriptor* oneof;
    QComboBox* list;
    std::vector<Row> rows;
  };

  std::string inner(const std::string& name) const;
  Row make_row(const Field& field);
  void add_field(const Field& field);
  void add_choice(const google::protobuf::OneofDescriptor& oneof);
  void show_chosen(const Choice& choice);
  static void show_row(const Row& row, const google::protobuf::Message& message);
  static void store_row(const Row& row, google::protobuf::Message& message);

  std::string path_;
  Facts facts_;
  Wanted wanted_;
  QFormLayout* layout_;
  std::vector<Row> rows_;
  std::vector<Choice> choices_;
  std::map<std::string, QWidget*> editors_;
};

}  // namespace metamer::gui
