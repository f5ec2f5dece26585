#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "client/gui/link/link.h"
#include "client/tools/tradeoff/tradeoff_steps.h"

namespace metamer::gui {

/// Every method rendered on one scene by the window's own session, one job after the other. Ends
/// with one of its last two signals; where it goes before, its job is cancelled.
class TradeoffJob : public QObject {
  Q_OBJECT
 public:
  /// `rounds`: renderings of each, 1 or more; the quickest counts.
  TradeoffJob(Link& link, std::shared_ptr<const v1::Scene> scene, std::vector<Asset> assets,
              const QString& name, unsigned rounds, QObject* parent);
  ~TradeoffJob() override;

  /// Ends it with `stopped`, as soon as the server has.
  void cancel();

 Q_SIGNALS:
  /// Before each job.
  void begun(unsigned job, unsigned jobs, const QString& method);
  void finished(const std::shared_ptr<const client::Tradeoff>& tradeoff);
  void stopped(const QString& why);

 private:
  /// Shared with the pool, which compares pictures.
  struct Shared {
    Shared(std::shared_ptr<const v1::Scene> sent, std::vector<Asset> files, const QString& name,
           unsigned rounds)
        : scene(std::move(sent)),
          assets(std::move(files)),
          steps({*scene, assets, name.toStdString()}, rounds) {}
    std::shared_ptr<const v1::Scene> scene;
    std::vector<Asset> assets;
    client::TradeoffSteps steps;
  };
  using Done = tl::expected<void, client::TradeoffStop>;

  void begin_next();
  void watch(const client::JobHandle& job);
  void take(const Done& done);
  void order_cancel();

  Link& link_;
  std::shared_ptr<Shared> shared_;
  client::JobHandle job_;  ///< Under way.
  bool cancelled_ = false;
};

/// A sentence.
QString stop_text(const client::TradeoffStop& stop);

}  // namespace metamer::gui
