#include "client/gui/sheet/sheet_work.h"

#include <QObject>
#include <algorithm>

#include "client/gui/picture/tile.h"
#include "client/tools/pictures/relit_scene.h"
#include "client/tools/scene/light_words.h"
#include "client/tools/scene/words.h"
#include "common/scene/settings.h"

namespace metamer::gui {
namespace {

AssetReader reader_of(const client::CheckedScene& files) {
  return [&files](const std::string& name) { return files.read_asset(name); };
}

Result<NamedSpectrum> sheet_light(const QString& word, const client::CheckedScene& files) {
  return client::embedded_spectrum(word.toStdString(), SpectrumRole::emission, files.folder())
      .and_then([&](const v1::Spectrum& message) {
        return load_spectrum(message, {}, SpectrumRole::emission, reader_of(files));
      })
      .map([&](Spectrum&& spectrum) {
        return NamedSpectrum{.name = word.toStdString(), .spectrum = std::move(spectrum)};
      });
}

/// The place of a material in the scene's list; -1: there is none of that name.
int material_named(const v1::Scene& scene, const QString& name) {
  for (int i = 0; i < scene.material_size(); ++i)
    if (scene.material(i).name() == name.toStdString()) return i;
  return -1;
}

Result<NamedSpectrum> sheet_paint(const QString& word, const v1::Scene& scene,
                                  const client::CheckedScene& files) {
  const int material = material_named(scene, word);
  const Result<v1::Spectrum> message =
      material >= 0
          ? scene.material(material).diffuse()
          : client::embedded_spectrum(word.toStdString(), SpectrumRole::property, files.folder());
  return message
      .and_then([&](const v1::Spectrum& one) {
        return load_spectrum(one, {}, SpectrumRole::property, reader_of(files));
      })
      .map([&](Spectrum&& spectrum) {
        return NamedSpectrum{.name = word.toStdString(), .spectrum = std::move(spectrum)};
      });
}

Result<client::SheetQuestion> question_of(const SheetBase& base, const SheetWish& wish) {
  client::SheetQuestion question;
  for (const QString& word : wish.lights) {
    auto light = sheet_light(word, *base.files);
    if (!light) return tl::unexpected(std::move(light.error()));
    question.lights.push_back(std::move(*light));
  }
  for (const QString& word : wish.paints) {
    auto paint = sheet_paint(word, base.wanted, *base.files);
    if (!paint) return tl::unexpected(std::move(paint.error()));
    question.paints.push_back(std::move(*paint));
  }
  for (const QString& name : wish.painted.isEmpty() ? wish.paints : QStringList(wish.painted))
    if (const int at = material_named(base.wanted, name); at >= 0) question.materials.push_back(at);
  if (question.materials.empty())
    return problem("no paint is a material of the scene: choose the material that is painted");
  return question;
}

QString title_of(const SheetBase& base, const v1::Plan& plan, const SheetWish& wish) {
  const std::string observer =
      plan.observer_file().empty()
          ? client::word_of(*v1::Observer_descriptor()->FindValueByNumber(plan.observer()))
          : plan.observer_file();
  return QObject::tr("%1 · observer %2 · white: each light's own · reference light %3")
      .arg(QString::fromStdString(base.files->name()), QString::fromStdString(observer),
           wish.lights.front());
}

}  // namespace

Result<MadeSheet> make_sheet(const SheetBase& base, const SheetWish& wish) {
  if (wish.lights.size() < least_lights || wish.lights.size() > most_lights)
    return problem("a sheet has 2 to 8 lights");
  if (wish.paints.size() < 2) return problem("choose two paints");
  auto question = question_of(base, wish);
  if (!question) return tl::unexpected(std::move(question.error()));
  const client::Factors& factors = *base.picture.factors;
  auto relit =
      client::relit_scene(factors, *base.picture.scene, base.wanted, reader_of(*base.files));
  if (!relit) return tl::unexpected(std::move(relit.error()));
  auto made = client::metamerism_sheet(factors, relit->scene, relit->plan, *question);
  if (!made) return tl::unexpected(std::move(made.error()));
  auto picture = client::contact_sheet(made->sheet);
  if (!picture) return tl::unexpected(std::move(picture.error()));
  const std::shared_ptr<const Image> there(std::shared_ptr<void>(), &*picture);
  QImage shown = whole_image({there, made->developing});
  return MadeSheet{.wish = wish,
                   .made = std::move(*made),
                   .picture = std::move(*picture),
                   .shown = std::move(shown),
                   .title = title_of(base, relit->plan, wish)};
}

std::optional<std::pair<QString, QString>> pair_of(const v1::Scene& scene,
                                                   const client::CheckedScene& files,
                                                   const QStringList& words) {
  std::vector<NamedSpectrum> lights, paints;
  for (const QString& word : words)
    if (auto light = sheet_light(word, files)) lights.push_back(std::move(*light));
  // The last of a scene that has many: walls and floors come first.
  for (int i = scene.material_size(); i-- > 0 && paints.size() < client::most_paired;)
    if (auto paint = sheet_paint(QString::fromStdString(scene.material(i).name()), scene, files))
      paints.push_back(std::move(*paint));
  std::reverse(paints.begin(), paints.end());
  if (lights.empty()) return std::nullopt;
  const auto pair =
      client::metameric_pair(paints, lights, to_observer(scene.settings().observer()));
  if (!pair) return std::nullopt;
  return std::pair(QString::fromStdString(paints[pair->first].name),
                   QString::fromStdString(paints[pair->second].name));
}

}  // namespace metamer::gui
