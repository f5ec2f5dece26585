// The page of models has all that the catalogue has, and its diagrams are those of `models plot`.
#include "client/gui/models/models_page.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "tests/client/gui/command_line.h"

namespace metamer::gui {
namespace {

/// The row of the i-th line of the catalogue.
QTreeWidgetItem* row_of(ModelsPage& page, const client::CatalogueItem& item) {
  for (QTreeWidgetItem* row :
       page.tree().findItems(QString::fromUtf8(item.name), Qt::MatchExactly | Qt::MatchRecursive))
    if (row->parent() != nullptr && row->parent()->text(0) == QString::fromUtf8(item.kind))
      return row;
  return nullptr;
}

/// Chooses it and waits for its diagram.
bool show_item(ModelsPage& page, const client::CatalogueItem& item) {
  QSignalSpy shown(&page, &ModelsPage::shown);
  page.tree().setCurrentItem(page.tree().topLevelItem(0));
  page.tree().setCurrentItem(row_of(page, item));
  return shown.wait(10000);
}

TEST(ModelsPage, HasAllOfTheCatalogueWithTextRangesAndDiagram) {
  ModelsPage page;
  const QAbstractItemModelTester tester(page.tree().model(),
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  for (const client::CatalogueItem& item : client::catalogue()) {
    SCOPED_TRACE(std::string(item.kind) + " " + item.name);
    ASSERT_NE(row_of(page, item), nullptr);
    ASSERT_TRUE(show_item(page, item));
    EXPECT_TRUE(page.text().contains(QString::fromUtf8(item.citation).toHtmlEscaped()));
    EXPECT_TRUE(page.text().contains(QString::fromUtf8(item.equation).toHtmlEscaped()));
    EXPECT_EQ(client::csv_text(page.plot().figure()),
              client::csv_text(client::figure_of(item, {})));
    const auto parameters = client::plot_parameters(item);
    ASSERT_EQ(page.parameters().size(), parameters.size());
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto* box = page.parameters()[i]->findChild<QDoubleSpinBox*>();
      EXPECT_DOUBLE_EQ(box->minimum(), parameters[i].min) << parameters[i].name;
      EXPECT_DOUBLE_EQ(box->maximum(), parameters[i].max) << parameters[i].name;
      EXPECT_DOUBLE_EQ(box->value(), parameters[i].default_value) << parameters[i].name;
      EXPECT_FALSE(page.parameters()[i]->value()) << "left to the diagram";
    }
  }
}

TEST(ModelsPage, DiagramOfASetParameterIsThatOfModelsPlot) {
  ModelsPage page;
  ASSERT_TRUE(show_item(page, client::find_items("blinn_phong")->front()));
  QSignalSpy shown(&page, &ModelsPage::shown);
  for (ParameterBox* box : page.parameters())
    if (std::string(box->parameter().name) == "shininess") box->set_value(120);
  ASSERT_TRUE(shown.wait(10000));
  const QTemporaryDir folder;
  answer_of({"models", "plot", "blinn_phong", "--set", "shininess=120", "-o", folder.path()});
  QFile numbers(folder.filePath(QStringLiteral("model-blinn_phong.csv")));
  ASSERT_TRUE(numbers.open(QIODevice::ReadOnly));
  EXPECT_EQ(QByteArray::fromStdString(client::csv_text(page.plot().figure())), numbers.readAll());
  EXPECT_TRUE(page.plot().save(folder.filePath(QStringLiteral("own.csv"))));
  for (const char* file : {"own.pdf", "own.png"}) {
    const QString path = folder.filePath(QString::fromLatin1(file));
    EXPECT_TRUE(page.plot().save(path)) << file;
    EXPECT_GT(QFile(path).size(), 1000) << file;
  }
  EXPECT_FALSE(page.plot().save(folder.filePath(QStringLiteral("own.txt"))));
}

TEST(ModelsPage, ShowsTheSourcesDiagrams) {
  ModelsPage page;
  const auto group = [&] {
    const auto found = page.tree().findItems(QStringLiteral("source"), Qt::MatchContains);
    return found.isEmpty() ? nullptr : found.front();
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return group() != nullptr; }, 20000));
  ASSERT_GE(group()->childCount(), 8);
  for (int i = 0; i < group()->childCount(); ++i) {
    page.tree().setCurrentItem(group()->child(i));
    EXPECT_FALSE(page.plot().figure().panels.empty());
    EXPECT_TRUE(page.parameters().empty());
  }
  page.resize(1000, 800);
  take_shot(page, QStringLiteral("models-source"));
  ASSERT_TRUE(show_item(page, client::find_items("ward")->front()));
  take_shot(page, QStringLiteral("models-round"));
  ASSERT_TRUE(show_item(page, client::find_items("beckmann")->front()));
  take_shot(page, QStringLiteral("models-straight"));
}

}  // namespace
}  // namespace metamer::gui
