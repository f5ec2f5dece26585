// The window's log: what was said stands in it, whoever said it.
#include "client/gui/log/log.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QClipboard>
#include <QGuiApplication>
#include <QTest>

#include "../jobs/jobs_window.h"
#include "client/gui/log/log_dock.h"
#include "client/gui/spectra/spectra_window.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

/// Whether a line of that kind has all of these words.
bool has_line(const Log& log, LogKind kind, const QStringList& words) {
  for (int row = 0; row < log.rowCount(); ++row)
    if (log.kind_of(row) == kind &&
        std::all_of(words.begin(), words.end(),
                    [&](const QString& word) { return log.line(row).contains(word); }))
      return true;
  return false;
}

TEST(Log, HoldsTheNewestLinesInTheirOrder) {
  Log log;
  const auto write = [&log](int from, int to) {
    for (int i = from; i < to; ++i)
      log.write(LogKind::note, QStringLiteral("a"), QString::number(i));
  };
  write(0, Log::most - 10);
  // It looks at every line whenever one comes.
  const QAbstractItemModelTester tester(&log,
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  write(Log::most - 10, Log::most + 10);
  ASSERT_EQ(log.rowCount(), Log::most);
  EXPECT_TRUE(log.line(0).endsWith(QStringLiteral(" 10"))) << log.line(0).toStdString();
  EXPECT_TRUE(log.line(Log::most - 1).endsWith(QString::number(Log::most + 9)));
  log.clear();
  EXPECT_EQ(log.rowCount(), 0);
}

TEST(Log, WhatWasJustSaidIsNotSaidAgain) {
  Log log;
  for (int i = 0; i < 3; ++i) log.write(LogKind::warning, QStringLiteral("a"), QStringLiteral("b"));
  EXPECT_EQ(log.rowCount(), 1);
  log.write(LogKind::error, QStringLiteral("a"), QStringLiteral("b"));
  log.write(LogKind::error, {}, QStringLiteral("b"));
  log.write(LogKind::error, {}, {});
  EXPECT_EQ(log.rowCount(), 3);
}

TEST(Log, EachIsOneLineWhoeverWroteIt) {
  Log log;
  log.write(LogKind::note, QStringLiteral("a\nb"),
            QStringLiteral("one\r\ntwo\x1b[31m\u2028\u202ethree"));
  const QString line = log.line(0);
  for (const QChar bad : {QChar(u'\n'), QChar(u'\r'), QChar(0x1b), QChar(0x2028), QChar(0x202e)})
    EXPECT_FALSE(line.contains(bad)) << line.toStdString();
}

class LogDockTest : public testing::Test {
 protected:
  LogDockTest() {
    log.write(LogKind::note, QStringLiteral("booth"), QStringLiteral("started"));
    log.write(LogKind::warning, QStringLiteral("booth"), QStringLiteral("21 of 81 below"));
    log.write(LogKind::error, QStringLiteral("ball"), QStringLiteral("it is no mesh"));
  }
  int shown() { return dock.view().model()->rowCount(); }

  Log log;
  LogDock dock{log};
};

TEST_F(LogDockTest, ShowsTheLinesThatHaveAllWords) {
  EXPECT_EQ(shown(), 3);
  const std::pair<const char*, int> filters[] = {
      {"booth", 2}, {"BOOTH below", 1}, {"warning", 1}, {"booth mesh", 0}, {"", 3}};
  for (const auto& [words, count] : filters) {
    dock.words().setText(QString::fromUtf8(words));
    EXPECT_EQ(shown(), count) << words;
  }
  dock.no_notes().setChecked(true);
  EXPECT_EQ(shown(), 2);
}

TEST_F(LogDockTest, CopiesWhatIsChosenElseWhatIsShown) {
  dock.copy();
  EXPECT_EQ(QGuiApplication::clipboard()->text().count(QLatin1Char('\n')), 3);
  dock.words().setText(QStringLiteral("booth"));
  dock.copy();
  EXPECT_EQ(QGuiApplication::clipboard()->text(), log.line(0) + u'\n' + log.line(1) + u'\n');
  dock.view().selectRow(1);
  dock.view().setFocus();
  QTest::keyClick(&dock.view(), Qt::Key_C, Qt::ControlModifier);
  dock.copy();
  EXPECT_EQ(QGuiApplication::clipboard()->text(), log.line(1) + u'\n');
}

using WindowLog = OpenedScene;

TEST_F(WindowLog, HasWhatTheStatusBarSays) {
  window.say(QStringLiteral("written"));
  EXPECT_TRUE(has_line(window.log(), LogKind::note, {QStringLiteral("written")}));
}

TEST_F(WindowLog, HasAServerThatIsNotThere) {
  link.open(QStringLiteral("unix:/nobody/listens/here"));
  EXPECT_TRUE(wait([&] {
    return has_line(window.log(), LogKind::error,
                    {QStringLiteral("unix:/nobody/listens/here"), QStringLiteral("trying again")});
  }));
}

TEST(JobLog, HasTheStatesAndTheNoticesOfAJob) {
  test::JobsWindow test(test::blink_scene(
      "width: 16 height: 12 spp: 1 method { point { from: 400 to: 700 step: 50 } }"));
  test.choose("render.render");
  JobPage* page = test.job();
  ASSERT_TRUE(test::comes([page] { return page->picture().has_value(); }));
  const Log& log = test.window().log();
  EXPECT_TRUE(has_line(log, LogKind::note, {QStringLiteral("private server: ready")}));
  EXPECT_TRUE(has_line(log, LogKind::note, {QStringLiteral("scene.txtpb: finished")}));
  ASSERT_GT(page->picture()->plan->notice_size(), 0);
  for (const v1::Notice& notice : page->picture()->plan->notice())
    EXPECT_TRUE(
        has_line(log, LogKind::warning,
                 {QStringLiteral("scene.txtpb: "), QString::fromStdString(notice.message())}));
}

TEST_F(WindowLog, HasWhatIsToBeKnownOfFilesThatAreReadAndThoseThatAreNot) {
  open(sound);
  write(QStringLiteral("even.txt"), "400 50\n500 60\n600 70\n");
  action("spectra.manager")->trigger();
  auto* spectra = window.findChild<SpectraWindow*>();
  ASSERT_NE(spectra, nullptr);
  spectra->lists().add({path(QStringLiteral("nowhere.txt"))});
  EXPECT_TRUE(wait(
      [&] { return has_line(window.log(), LogKind::error, {QStringLiteral("nowhere.txt")}); }));
  spectra->lists().add({path(QStringLiteral("even.txt"))});
  EXPECT_TRUE(wait([&] {
    return has_line(window.log(), LogKind::warning,
                    {QStringLiteral("even.txt"), QStringLiteral("taken for an emission")});
  }));
}

TEST(JobLog, HasWhyAJobFailed) {
  test::JobsWindow test(test::blink_scene("width: 16 height: 12 spp: 1") +
                        "object { name: \"bad\" material: \"ball\" mesh { file: \"bad.ply\" } }\n");
  test.choose("render.render");
  JobPage* page = test.job();
  ASSERT_TRUE(test::comes([page] { return page->panel().ended(); }));
  EXPECT_TRUE(has_line(test.window().log(), LogKind::error, {QStringLiteral("bad.ply")}));
}

}  // namespace
}  // namespace metamer::gui
