#include "client/gui/forms/settings_form.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QStandardItemModel>
#include <functional>

#include "../jobs/jobs_window.h"
#include "client/gui/forms/settings_dialog.h"
#include "common/scene/parts.h"

namespace metamer::gui {
namespace {

namespace pb = google::protobuf;

v1::Settings form_settings(const std::string& text) {
  v1::Settings settings;
  EXPECT_TRUE(pb::TextFormat::ParseFromString(text, &settings)) << text;
  return settings;
}

using Visit = std::function<void(const std::string& path, const pb::FieldDescriptor& field)>;

/// Each field of a message and of what it holds, by its path.
void for_each_field(const pb::Descriptor& type, const std::string& before, const Visit& visit) {
  for (int i = 0; i < type.field_count(); ++i) {
    const pb::FieldDescriptor& field = *type.field(i);
    const std::string path = before + field.name();
    if (!has_settings_row(path)) continue;
    visit(path, field);
    if (field.message_type() != nullptr) for_each_field(*field.message_type(), path + '.', visit);
  }
}
void for_each_field(const Visit& visit) { for_each_field(*v1::Settings::descriptor(), "", visit); }

TEST(SettingsForm, EachFieldOfTheSettingsHasAnEditorWithANameAndAHelpText) {
  const SettingsForm form;
  int fields = 0;
  for_each_field([&](const std::string& path, const pb::FieldDescriptor& field) {
    ++fields;
    const QWidget* editor = form.form().editor(path);
    ASSERT_NE(editor, nullptr) << path;
    EXPECT_GE(settings_facts(path).help.size(), 2) << path;
    EXPECT_FALSE(editor->toolTip().isEmpty()) << path;
    if (field.message_type() == nullptr) {
      EXPECT_FALSE(editor->accessibleName().isEmpty()) << path;
    }
  });
  EXPECT_GT(fields, 30);
}

TEST(SettingsForm, GivesBackWhatItWasShown) {
  for (const char* text :
       {"", "width: 20 height: 30 spp: 1 depth: 0 threads: 3 tile_size: 8",
        "observer: CIE_1964_10DEG shading: GOURAUD backend: GL verify: true",
        "observer_file: \"me.csv\"", "method { point { from: 400.5 to: 700 step: 0.1 } }",
        "method { point { fitted: 4 lights: CELLS multi_pass: true } }",
        "method { point { wavelengths: [450, 550.25, 650] } }",
        "method { linear { bases: 7 bounce: true weighting: OBSERVER } }", "method { exact {} }",
        "method { rgb {} }", "method { prefilter {} }", "goal { tolerance: 0.2 }",
        "goal { deadline: 2 }",
        "development { adaptation: NO_ADAPTATION rgb_space: REC_2020 linear: true }",
        "development { primaries { red: [0.6, 0.3] green: [0.2, 0.7] blue: [0.1, 0.1] white: "
        "[0.31, 0.33] gamma: 2.2 } }"}) {
    SettingsForm form;
    const v1::Settings settings = form_settings(text);
    form.show_settings(settings);
    EXPECT_EQ(form.settings().DebugString(), settings.DebugString()) << text;
    form.show_settings({});
    EXPECT_EQ(form.settings().DebugString(), "") << "after " << text;
  }
}

TEST(SettingsForm, ShowsTheOlderGoalAsTheGoal) {
  SettingsForm form;
  form.show_settings(form_settings("method { auto { deadline: 3 } }"));
  EXPECT_EQ(form.settings().DebugString(), form_settings("goal { deadline: 3 }").DebugString());
}

/// How much check_settings finds wrong where a number is all that is set, but for what has to go
/// with it.
std::size_t problems_with(const std::string& path, const pb::FieldDescriptor& field, double value) {
  v1::Settings settings;
  if (path == "method.point.from" || path == "method.point.to")
    settings = form_settings("method { point { from: 1 to: 10000 step: 9999 } }");
  if (path == "development.primaries.gamma")
    settings = form_settings(
        "development { primaries { red: [0.6, 0.3] green: [0.2, 0.7] blue: [0.1, 0.1] white: "
        "[0.31, 0.33] } }");
  pb::Message* holder = &settings;
  for (std::size_t at = 0, dot = 0; (dot = path.find('.', at)) != std::string::npos; at = dot + 1)
    holder = holder->GetReflection()->MutableMessage(
        holder, holder->GetDescriptor()->FindFieldByName(path.substr(at, dot - at)));
  if (field.cpp_type() == pb::FieldDescriptor::CPPTYPE_UINT32)
    holder->GetReflection()->SetUInt32(holder, &field, static_cast<std::uint32_t>(value));
  else
    holder->GetReflection()->SetDouble(holder, &field, value);
  Findings findings;
  check_settings(settings, "settings", findings);
  return findings.size();
}

TEST(SettingsForm, NumbersTakeWhatTheChecksTakeAndNoMore) {
  int ranges = 0;
  for_each_field([&](const std::string& path, const pb::FieldDescriptor& field) {
    const auto range = settings_facts(path).range;
    const bool whole = field.cpp_type() == pb::FieldDescriptor::CPPTYPE_UINT32;
    if (whole) {
      EXPECT_TRUE(range) << path << ": a spin box has an end";
    }
    if (!range || path == "method.point.step") return;  // a step is bound by how many it makes
    ++ranges;
    EXPECT_EQ(problems_with(path, field, range->least), 0U) << path;
    if (!whole) {
      EXPECT_NE(problems_with(path, field, 0), 0U) << path;
      return;
    }
    EXPECT_EQ(problems_with(path, field, range->greatest), 0U) << path;
    EXPECT_NE(problems_with(path, field, range->greatest + 1), 0U) << path;
    if (range->least > 0) {
      EXPECT_NE(problems_with(path, field, range->least - 1), 0U) << path;
    }
  });
  EXPECT_GE(ranges, 12);
}

void choose_word(const SettingsForm& form, const char* path, const char* word) {
  auto* list = qobject_cast<QComboBox*>(form.form().editor(path));
  ASSERT_NE(list, nullptr) << path;
  list->setCurrentText(QString::fromUtf8(word));
  Q_EMIT list->activated(list->currentIndex());
}

TEST(SettingsForm, AMethodTakesThePlaceOfAGoalAndAGoalThatOfAMethod) {
  SettingsForm form;
  form.show_settings(form_settings("goal { tolerance: 0.2 }"));
  choose_word(form, "method.method", "linear");
  EXPECT_TRUE(form.settings().method().has_linear());
  EXPECT_FALSE(form.settings().has_goal());
  choose_word(form, "goal.goal", "tolerance");
  auto* tolerance = qobject_cast<QLineEdit*>(form.form().editor("goal.tolerance"));
  ASSERT_NE(tolerance, nullptr);
  tolerance->setText(QStringLiteral("0.3"));
  Q_EMIT tolerance->textEdited(tolerance->text());
  EXPECT_EQ(form.settings().DebugString(), form_settings("goal { tolerance: 0.3 }").DebugString());
}

/// Whether an entry of a list can be chosen; its tool tip.
bool can_choose(const SettingsForm& form, const char* path, const char* word, QString& tip) {
  auto* list = qobject_cast<QComboBox*>(form.form().editor(path));
  EXPECT_NE(list, nullptr) << path;
  const auto* item = qobject_cast<QStandardItemModel*>(list->model())
                         ->item(list->findText(QString::fromUtf8(word)));
  EXPECT_NE(item, nullptr) << word;
  tip = item->toolTip();
  return item->isEnabled();
}

TEST(SettingsForm, WhatTheServerLacksCannotBeChosenAndSaysWhy) {
  SettingsForm form;
  v1::Capabilities capabilities;
  capabilities.add_backend("cpu");
  capabilities.add_method("exact");
  v1::FeatureSet* cpu = capabilities.add_backend_features();
  cpu->set_name("cpu");
  cpu->add_feature("mirrors");
  form.set_capabilities(capabilities);
  QString tip;
  EXPECT_TRUE(can_choose(form, "backend", "cpu", tip));
  EXPECT_FALSE(can_choose(form, "backend", "gl", tip));
  EXPECT_EQ(tip, QStringLiteral("this server has no GL backend"));
  EXPECT_TRUE(can_choose(form, "method.method", "exact", tip));
  EXPECT_FALSE(can_choose(form, "method.method", "linear", tip));
  EXPECT_TRUE(tip.contains(QStringLiteral("linear")));
  EXPECT_TRUE(form.form().editor("depth")->isEnabled());
  const QWidget* passes = form.form().editor("method.point.multi_pass");
  EXPECT_FALSE(passes->isEnabled());
  EXPECT_TRUE(passes->toolTip().contains(QStringLiteral("multi_pass")));
}

QPushButton* find_button(SettingsDialog& dialog, const char* text) {
  for (QPushButton* button : dialog.findChildren<QPushButton*>())
    if (button->text() == QString::fromUtf8(text)) return button;
  ADD_FAILURE() << "no button " << text;
  return nullptr;
}

TEST(SettingsDialog, SaysWhatIsWrongAndRendersNothing) {
  SettingsDialog dialog(form_settings("method { point { from: 700 to: 400 step: 5 } }"), {});
  EXPECT_FALSE(find_button(dialog, "Render")->isEnabled());
  EXPECT_TRUE(dialog.form().problems().join(QString()).contains(QStringLiteral("below from")));
}

TEST(SettingsDialog, ItsSettingsAreTheLiveViewsAndTheRenders) {
  test::JobsWindow test(test::blink_scene("width: 32 height: 24 spp: 4"));
  test.choose("render.settings");
  auto* dialog = test.window().findChild<SettingsDialog*>();
  ASSERT_NE(dialog, nullptr);
  EXPECT_EQ(dialog->settings().spp(), 4U);
  find_button(*dialog, "Draft")->click();
  EXPECT_EQ(dialog->settings().spp(), 1U);
  find_button(*dialog, "Use for the live view")->click();
  const Result<v1::Scene> live = test.document().effective();
  ASSERT_TRUE(live);
  EXPECT_EQ(live->settings().spp(), 1U);
  EXPECT_EQ(live->settings().width(), 32U);
  find_button(*dialog, "Final")->click();
  find_button(*dialog, "Render")->click();
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(test::comes([page] { return page->picture().has_value(); }));
  EXPECT_EQ(page->picture()->plan->spp(), 64U);
  EXPECT_EQ(test.document().effective()->settings().spp(), 1U) << "rendering changes no look";
}

}  // namespace
}  // namespace metamer::gui
