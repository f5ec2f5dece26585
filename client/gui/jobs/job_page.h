#pragma once

#include <vector>

#include "client/gui/jobs/job_panel.h"
#include "client/gui/jobs/job_watch.h"
#include "client/gui/picture/picture_page.h"
#include "common/scene/scene_file.h"

namespace metamer::gui {

/// A job: its picture as it grows, and below it how it stands.
class JobPage : public PicturePage {
  Q_OBJECT
 public:
  explicit JobPage(Link& link, QWidget* parent = nullptr);

  /// Sends a scene and watches its job. `name` is for people.
  void render(std::shared_ptr<const v1::Scene> scene, std::vector<Asset> assets, QString name);
  /// Watches a job that is there.
  void watch(const client::JobHandle& job, const QString& name);

  Canvas& canvas() override { return *canvas_; }
  /// As it is shown: as it was rendered, or under another look.
  std::optional<Picture> picture() const override { return relit_ ? relit_ : picture_; }
  const std::optional<Picture>& rendered() const { return picture_; }
  /// What came of it: nothing before its end.
  const std::optional<v1::Finished>& finished() const { return finished_; }
  /// The picture under another look; `note` stands over it. Nothing: as it was rendered.
  void show_relit(const std::optional<Picture>& relit, const QString& note);
  void pause() override;
  void cancel() override;

  /// Its number is 0 before the server has taken it.
  const client::JobHandle& job() const { return job_; }
  const JobPanel& panel() const { return *panel_; }
  const std::vector<Asset>& assets() const { return assets_; }
  const QString& name() const { return name_; }
  /// "booth.txtpb 63 %"
  QString title() const;

 Q_SIGNALS:
  void titled();
  void exact_asked();  ///< The same scene by the method exact.
  void completed();    ///< picture() is there.
  void sent();         ///< job() is there.

 private:
  void order(Link::Order order);
  void follow_link();
  void take(const v1::JobEvent& event);
  void keep(const std::shared_ptr<client::JobRecord>& record);
  void complete(const std::shared_ptr<client::JobRecord>& record,
                std::shared_ptr<const client::Factors> factors);

  Link& link_;
  Canvas* canvas_;
  JobPanel* panel_;
  JobWatch* watch_ = nullptr;
  client::JobHandle job_;
  QString name_;
  std::shared_ptr<const v1::Scene> scene_;
  std::vector<Asset> assets_;
  std::optional<Picture> picture_, relit_;
  std::optional<v1::Finished> finished_;
};

}  // namespace metamer::gui
