#include "client/gui/jobs/jobs_dock.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QDockWidget>
#include <QMessageBox>
#include <QPushButton>

#include "client/gui/jobs/check_page.h"
#include "jobs_window.h"

namespace metamer::test {
namespace {

v1::JobSummary summary(std::uint64_t number, const char* name, v1::JobState state) {
  v1::JobSummary job;
  job.set_job_id(number);
  job.set_name(name);
  job.set_state(state);
  job.set_tiles(4);
  job.set_tiles_done(1);
  return job;
}

v1::JobList list_of(std::initializer_list<v1::JobSummary> jobs) {
  v1::JobList list;
  for (const v1::JobSummary& job : jobs) *list.add_job() = job;
  return list;
}

TEST(JobTable, KeepsRowsOfJobsThatStayAndOrdersByNumber) {
  gui::JobTable table;
  const QAbstractItemModelTester tester(&table,
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  table.set_jobs(list_of({summary(1, "a", v1::RUNNING), summary(3, "c", v1::QUEUED)}));
  const QPersistentModelIndex third = table.index(1, 0);
  table.set_jobs(list_of({summary(2, "b", v1::QUEUED), summary(3, "c", v1::RUNNING)}));
  ASSERT_EQ(table.rowCount(), 2);
  EXPECT_EQ(table.job(0).job_id(), 2U);
  ASSERT_TRUE(third.isValid());
  EXPECT_EQ(third.row(), 1);
  EXPECT_EQ(table.job(1).state(), v1::RUNNING);
  EXPECT_EQ(table.index(1, gui::JobTable::done).data().toString(), QStringLiteral("25 %"));
  table.set_jobs({});
  EXPECT_EQ(table.rowCount(), 0);
}

TEST(JobTable, AJobOfAnotherServerIsAnotherThoughItsNumberIsTheSame) {
  gui::JobTable table;
  const QAbstractItemModelTester tester(&table,
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  const std::string first(32, 'a'), second(32, 'b');
  table.set_jobs(list_of({summary(7, "a", v1::RUNNING)}), first);
  table.add_own({7, first});
  const QPersistentModelIndex row = table.index(0, 0);
  EXPECT_TRUE(table.is_own(table.job(0)));
  EXPECT_EQ(row.data().toString(), QStringLiteral("7@aaaaaaaa"));

  table.set_jobs(list_of({summary(7, "b", v1::RUNNING)}), second);
  ASSERT_EQ(table.rowCount(), 1);
  EXPECT_FALSE(row.isValid()) << "who has chosen it has chosen none of the new ones";
  EXPECT_FALSE(table.is_own(table.job(0)));
  EXPECT_NE(table.handle_of(table.job(0)), (client::JobHandle{7, first}));

  table.set_jobs(list_of({summary(7, "a", v1::RUNNING)}), first);
  EXPECT_TRUE(table.is_own(table.job(0)));
}

TEST(JobTable, ANameCannotCommandTheWindow) {
  gui::JobTable table;
  table.set_jobs(list_of({summary(1, "two\nlines", v1::RUNNING)}));
  EXPECT_EQ(table.index(0, gui::JobTable::name).data().toString(), QStringLiteral("two?lines"));
}

TEST(JobFilter, KeepsWhatHasAllWordsAndIsWanted) {
  gui::JobTable table;
  gui::JobFilter filter(table);
  const QAbstractItemModelTester tester(&filter,
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  table.set_jobs(list_of({summary(1, "booth.txtpb", v1::RUNNING),
                          summary(2, "booth.txtpb", v1::FAILED), summary(3, "car", v1::QUEUED)}));
  EXPECT_EQ(filter.rowCount(), 3);
  filter.set_words(QStringLiteral("BOOTH fail"));
  EXPECT_EQ(filter.rowCount(), 1);
  filter.set_words({});
  filter.set_hide_ended(true);
  EXPECT_EQ(filter.rowCount(), 2);
  filter.set_own_only(true);
  EXPECT_EQ(filter.rowCount(), 0);
  table.add_own({3, {}});
  EXPECT_EQ(filter.rowCount(), 1);
}

TEST(JobTable, EachColumnHasAHeading) {
  const gui::JobTable table;
  for (int column = 0; column < table.columnCount(); ++column)
    EXPECT_FALSE(table.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString().isEmpty())
        << column;
}

/// Presses a button of the message box that comes next; counts the boxes.
void answer_next_box(QMessageBox::StandardButton button, int& boxes) {
  QTimer::singleShot(0, qApp, [button, &boxes] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
      ++boxes;
      box->button(button)->click();
    }
  });
}

QPushButton* dock_button(const QWidget& dock, const char* text) {
  for (QPushButton* button : dock.findChildren<QPushButton*>())
    if (button->text() == QString::fromUtf8(text)) return button;
  ADD_FAILURE() << "no button " << text;
  return nullptr;
}

TEST(JobsDock, ListsAJobOpensItsPictureAndAsksBeforeItCancelsAnothers) {
  JobsWindow test(blink_scene("width: 2048 height: 2048 spp: 1024 tile_size: 8"));
  auto* jobs = test.window().findChild<gui::JobsDock*>();
  ASSERT_NE(jobs, nullptr);
  test.window().findChild<QDockWidget*>(QStringLiteral("jobs"))->show();
  test.choose("render.render");
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([&] { return jobs->table().rowCount() == 1; }));
  EXPECT_TRUE(jobs->table().is_own(jobs->table().job(0)));

  // Its picture is the page that is there already.
  jobs->view().selectionModel();
  const_cast<QTableView&>(jobs->view()).selectRow(0);
  const int pages = test.window().pictures().count();
  test.window().pictures().setCurrentIndex(0);
  dock_button(*jobs, "Open picture")->click();
  EXPECT_EQ(test.window().pictures().count(), pages);
  EXPECT_EQ(test.window().pictures().currentWidget(), page);

  // Closed, it is opened anew by watching, as anybody's is.
  delete page;
  dock_button(*jobs, "Open picture")->click();
  page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->title().contains(QLatin1Char('%')); }));

  // As if it were another's.
  gui::JobsDock others(test.window().link());
  others.show();
  ASSERT_TRUE(comes([&] { return others.table().rowCount() == 1; }));
  const_cast<QTableView&>(others.view()).selectRow(0);
  int boxes = 0;
  answer_next_box(QMessageBox::No, boxes);
  dock_button(others, "Cancel")->click();
  EXPECT_EQ(boxes, 1);
  EXPECT_FALSE(page->panel().ended());
  answer_next_box(QMessageBox::Yes, boxes);
  dock_button(others, "Cancel")->click();
  EXPECT_EQ(boxes, 2);
  ASSERT_TRUE(comes([page] { return page->panel().ended(); }));
}

TEST(CheckPage, ShowsWhatEachStepTookAndLeavesNoPicture) {
  JobsWindow test(blink_scene("width: 75 height: 53 spp: 4"));
  test.choose("render.check");
  auto* page = qobject_cast<gui::CheckPage*>(test.window().pictures().currentWidget());
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->panel().ended(); }));
  EXPECT_TRUE(page->title().endsWith(QStringLiteral("✓"))) << page->title().toStdString();
  QStringList steps;
  for (int row = 0; row < page->times().rowCount(); ++row)
    steps << page->times().item(row, 0)->text();
  EXPECT_TRUE(steps.contains(QStringLiteral("reading"))) << steps.join(QString()).toStdString();
  EXPECT_TRUE(steps.contains(QStringLiteral("tables")));
  EXPECT_EQ(steps.back(), QStringLiteral("in all"));
  EXPECT_EQ(page->panel().state(), QStringLiteral("ready"));
  for (const QLabel* label : page->findChildren<QLabel*>())
    EXPECT_FALSE(label->isVisible() && label->text().contains(QStringLiteral("in all")))
        << "the table says it: " << label->text().toStdString();
}

}  // namespace
}  // namespace metamer::test
