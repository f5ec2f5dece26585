#pragma once

#include <QObject>
#include <QProcess>
#include <QTemporaryDir>
#include <memory>

#include "client/tools/spectra/spectra_files.h"

namespace metamer::gui {

/// How far a metamer and its original are apart under a light.
struct LightDifference {
  QString light;
  double de00, deab, deuv;
};

struct MadeMetamer {
  client::LoadedSpectrum original, metamer;
  QString text;  ///< The metamer as a file's text, CGATS.
  QList<LightDifference> differences;
};

/// What a metamer is made of.
struct MetamerOrder {
  QString original;                                       ///< A word, where there is one,
  std::shared_ptr<const client::LoadedSpectrum> samples;  ///< else the samples themselves.
  QString under, against, observer;                       ///< Words.
};

/// Metamers are made by `metamer spectra metamer`, the program beside this one: what finds them is
/// under a licence that this program's forbids to mix. One at a time; the newest order counts.
class MetamerMaker : public QObject {
  Q_OBJECT
 public:
  explicit MetamerMaker(QObject* parent = nullptr);
  ~MetamerMaker() override;

  void make(const MetamerOrder& order);

 Q_SIGNALS:
  void made(const std::shared_ptr<const MadeMetamer>& metamer);
  /// It can't be made, or the program is not there.
  void failed(const QString& why);

 private:
  void stop();
  void finish();
  void load(const QList<LightDifference>& differences);

  QTemporaryDir folder_;
  QProcess* process_ = nullptr;
  QString original_;  ///< The word that the program was given.
  quint64 orders_ = 0;
};

}  // namespace metamer::gui
