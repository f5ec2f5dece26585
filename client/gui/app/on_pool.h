#pragma once

#include <QFutureWatcher>
#include <QtConcurrentRun>
#include <type_traits>
#include <utility>

namespace metamer::gui {

/// Calls `make()` in the thread pool, then `done(what it returned)` in this thread, which has a
/// loop of events. Where `owner`, an object of this thread, is gone by then, nobody is told.
/// `make` holds all that it needs by itself.
template <class Make, class Done>
void on_pool(QObject* owner, Make make, Done done) {
  using Made = std::invoke_result_t<Make>;
  auto* watcher = new QFutureWatcher<Made>(owner);
  QObject::connect(watcher, &QFutureWatcherBase::finished, owner,
                   [watcher, done = std::move(done)] {
                     watcher->deleteLater();
                     done(watcher->result());
                   });
  watcher->setFuture(QtConcurrent::run(std::move(make)));
}

}  // namespace metamer::gui
