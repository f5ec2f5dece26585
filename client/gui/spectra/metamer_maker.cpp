#include "client/gui/spectra/metamer_maker.h"

#include <QCoreApplication>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/tools/spectra/worded_spectra.h"
#include "common/spectral/files/spectra_text.h"

namespace metamer::gui {
namespace {

using Made = Result<std::shared_ptr<const MadeMetamer>>;

QString metamer_program() {
  return QCoreApplication::applicationDirPath() + QStringLiteral("/metamer");
}

/// The samples as a file that the program reads.
bool write_samples(const client::LoadedSpectrum& one, const QString& file) {
  const auto text =
      spectra_text({{.name = one.name, .spectrum = one.samples}}, SpectrumFormat::pairs);
  QFile out(file);
  return text && out.open(QIODevice::WriteOnly) &&
         out.write(QByteArray::fromStdString(*text)) == static_cast<qint64>(text->size());
}

/// The sentences of what --json prints.
QString faults_in(const QJsonObject& answer) {
  QStringList said;
  for (const QJsonValue& one : answer[QStringLiteral("errors")].toArray()) said << one.toString();
  for (const QJsonValue& one : answer[QStringLiteral("problems")].toArray())
    said << one[QStringLiteral("message")].toString();
  return said.join(QLatin1Char('\n'));
}

QList<LightDifference> differences_in(const QJsonObject& answer) {
  QList<LightDifference> all;
  for (const QJsonValue& one : answer[QStringLiteral("differences")].toArray())
    all << LightDifference{
        one[QStringLiteral("light")].toString(), one[QStringLiteral("de00")].toDouble(),
        one[QStringLiteral("deab")].toDouble(), one[QStringLiteral("deuv")].toDouble()};
  return all;
}

/// Reads files.
Made load_made(const std::string& original, const QString& file,
               const QList<LightDifference>& differences) {
  QFile in(file);
  if (!in.open(QIODevice::ReadOnly)) return problem(in.errorString().toStdString());
  auto one = client::worded_spectra(original, {.reading = {.as = Quantity::reflectance}});
  auto other = client::worded_spectra(file.toStdString());
  if (!one || !other) return tl::unexpected((one ? other : one).error().problem);
  return std::make_shared<const MadeMetamer>(
      MadeMetamer{std::move(one->front().spectrum), std::move(other->front().spectrum),
                  QString::fromUtf8(in.readAll()), differences});
}

}  // namespace

MetamerMaker::MetamerMaker(QObject* parent) : QObject(parent) {}

MetamerMaker::~MetamerMaker() { stop(); }

/// Who destroys a process that runs waits for its end: it goes by itself.
void MetamerMaker::stop() {
  if (process_ == nullptr) return;
  process_->disconnect(this);
  process_->setParent(QCoreApplication::instance());
  connect(process_, &QProcess::finished, process_, &QObject::deleteLater);
  std::exchange(process_, nullptr)->kill();
}

void MetamerMaker::make(const MetamerOrder& order) {
  stop();
  ++orders_;
  original_ = order.original;
  if (original_.isEmpty()) {
    original_ = folder_.filePath(QStringLiteral("original.txt"));
    if (!order.samples || !write_samples(*order.samples, original_))
      return Q_EMIT failed(tr("the original can't be written into %1").arg(folder_.path()));
  }
  process_ = new QProcess(this);
  process_->setProgram(metamer_program());
  process_->setArguments({QStringLiteral("spectra"), QStringLiteral("metamer"), original_,
                          QStringLiteral("--under"), order.under, QStringLiteral("--against"),
                          order.against, QStringLiteral("--observer"), order.observer,
                          QStringLiteral("-o"), folder_.filePath(QStringLiteral("metamer.sp")),
                          QStringLiteral("--json")});
  connect(process_, &QProcess::finished, this, &MetamerMaker::finish);
  connect(process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error != QProcess::FailedToStart) return;
    process_->deleteLater();
    process_ = nullptr;
    Q_EMIT failed(tr("%1 can't be started: it stands beside this program").arg(metamer_program()));
  });
  process_->start();
}

void MetamerMaker::finish() {
  const QByteArray said = process_->readAllStandardOutput();
  const bool sound = process_->exitStatus() == QProcess::NormalExit && process_->exitCode() == 0;
  process_->deleteLater();
  process_ = nullptr;
  const QJsonObject answer = QJsonDocument::fromJson(said).object();
  if (sound) return load(differences_in(answer));
  const QString faults = faults_in(answer);
  Q_EMIT failed(faults.isEmpty() ? tr("metamer ended without a word") : faults);
}

void MetamerMaker::load(const QList<LightDifference>& differences) {
  on_pool(
      this,
      [original = original_.toStdString(), file = folder_.filePath(QStringLiteral("metamer.sp")),
       differences] { return load_made(original, file, differences); },
      [this, mine = orders_](const Made& made_one) {
        if (mine != orders_) return;
        if (made_one) return Q_EMIT made(*made_one);
        Q_EMIT failed(QString::fromStdString(made_one.error().message));
      });
}

}  // namespace metamer::gui
