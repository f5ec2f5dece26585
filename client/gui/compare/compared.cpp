#include "client/gui/compare/compared.h"

#include <QFileInfo>

#include "client/tools/scene/observers.h"
#include "client/tools/spectra/spectra_files.h"
#include "common/color/xyz.h"

namespace metamer::gui {
namespace {

Result<Spectrum> light_of(const QString& word) {
  const auto light = client::load_one(word.toStdString(), {.use = Use::emission});
  if (!light) return tl::unexpected(light.error().problem);
  if (!light->emission()) return problem(quoted(light->label) + " is a reflectance, no light");
  if (const std::string fault = client::emission_fault(light->samples); !fault.empty())
    return problem(quoted(light->label) + ": " + fault);
  return light->spectrum();
}

Result<Observer> observer_of(const QString& word) {
  auto observer = client::load_observer(word.toStdString());
  if (!observer) return tl::unexpected(observer.error().problem);
  return *std::move(observer);
}

/// As the command line has it: what is said, else the light that lit one of them, else sRGB's.
Result<client::White> white_of_choice(const CompareChoice& choice, const Observer& observer,
                                      bool lit) {
  const QString word = !choice.white.isEmpty() ? choice.white : lit ? choice.under : QString();
  if (word.isEmpty()) return client::srgb_white();
  const Result<Spectrum> light = light_of(word);
  if (!light) return tl::unexpected(light.error());
  return client::white_under(word.toStdString(), *light, observer);
}

Result<ComparedPicture> load_file(const PictureSource& source, const CompareChoice& choice) {
  const Result<Observer> observer = observer_of(choice.observer);
  if (!observer) return tl::unexpected(observer.error());
  const Result<Spectrum> under = light_of(choice.under);
  if (!under) return tl::unexpected(under.error());
  auto read =
      read_xyz(source.file.toStdString(), {.observer = *observer, .under = &*under}, source.choice);
  if (!read) return tl::unexpected(std::move(read.error()));
  auto picture = std::make_shared<const XyzPicture>(*std::move(read));
  return ComparedPicture{source.title(), picture, {{picture, &picture->image}}};
}

ComparedPicture take_picture(const Picture& picture) {
  auto xyz = std::make_shared<XyzPicture>();
  xyz->image = *picture.xyz;
  xyz->what = "X Y Z";
  return {picture.name(), xyz, shown_xyz(picture)};
}

QImage map_of(const Difference& difference, double top) {
  const std::vector<std::uint32_t> pixels = client::map_pixels(difference, top);
  return QImage(reinterpret_cast<const uchar*>(pixels.data()), difference.width, difference.height,
                difference.width * 4, QImage::Format_RGB32)
      .copy();
}

QStringList notes_of(const ComparedPicture& picture) {
  QStringList notes;
  for (const std::string& note : picture.xyz->notes)
    notes << QStringLiteral("%1: %2").arg(picture.title, QString::fromStdString(note));
  return notes;
}

}  // namespace

QString PictureSource::title() const {
  return picture ? picture->name() : QFileInfo(file).fileName();
}

Result<ComparedPicture> load_compared(const PictureSource& source, const CompareChoice& choice) {
  if (source.picture) return take_picture(*source.picture);
  return load_file(source, choice);
}

Result<std::shared_ptr<const Comparison>> compared(const ComparedPicture& a,
                                                   const ComparedPicture& b,
                                                   const CompareChoice& choice) {
  constexpr std::size_t bins = 100;
  const Result<Observer> observer = observer_of(choice.observer);
  if (!observer) return tl::unexpected(observer.error());
  if (const auto same = client::same_units({*a.xyz, *b.xyz}); !same)
    return tl::unexpected(same.error());
  const auto white = white_of_choice(choice, *observer, a.xyz->lit || b.xyz->lit);
  if (!white) return tl::unexpected(white.error());
  auto difference = compare(a.xyz->image, b.xyz->image, choice.metric, white->xyz);
  if (!difference) return tl::unexpected(std::move(difference.error()));
  auto made = std::make_shared<Comparison>();
  made->top = choice.top > 0 ? choice.top : client::usual_top(*difference);
  made->histogram = client::difference_histogram(*difference, bins, made->top);
  made->map = map_of(*difference, made->top);
  made->difference = *std::move(difference);
  made->white = *white;
  made->observer = QString::fromStdString(observer->name());
  made->notes = notes_of(a) + notes_of(b);
  made->a = a;
  made->b = b;
  return made;
}

Result<void> save_map(const Comparison& comparison, Metric metric, const QString& file) {
  const std::string title =
      comparison.a.title.toStdString() + " and " + comparison.b.title.toStdString();
  return false_color(comparison.difference, metric, comparison.top, title)
      .and_then(
          [&](const Image& image) { return write_image(image, file.toStdString(), false, {}); })
      .map([](const GamutReport&) {});
}

}  // namespace metamer::gui
