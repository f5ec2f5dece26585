#include "client/tools/pictures/metamerism_sheet.h"

#include <utility>

#include "client/relight/relight.h"
#include "client/tools/pictures/planned_developing.h"
#include "client/tools/pictures/relit.h"

namespace metamer::client {
namespace {

/// X Y Z as a screen of the developing's white shows it.
Image as_shown(Image picture, const Developing& developing) {
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) {
    const Xyz adapted =
        multiply(developing.adaptation,
                 Xyz{picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) picture.pixels[i + c] = static_cast<float>(adapted[c]);
  }
  return picture;
}

/// Fills the columns of a sheet, one after the other.
class SheetMaker {
 public:
  SheetMaker(const Factors& factors, const v1::SceneFactors& scene, const v1::Plan& plan,
             const SheetQuestion& question)
      : factors_(factors),
        scene_(scene),
        plan_(plan),
        question_(question),
        observer_(observer_of(plan, scene)) {
    Sheet& sheet = made_.sheet;
    sheet.maps = true;
    for (const NamedSpectrum& light : question.lights) sheet.lights.push_back(light.name);
    for (const NamedSpectrum& paint : question.paints) sheet.candidates.push_back(paint.name);
    sheet.candidates.push_back(question.paints.front().name + " by R, G, B");
    sheet.cells.resize(sheet.lights.size() * sheet.candidates.size());
  }

  const Observer& observer() const { return observer_; }

  void add_column(std::size_t column) {
    std::vector<v1::SceneFactors> scenes(question_.paints.size(), scene_);
    for (std::size_t row = 0; row < scenes.size(); ++row) {
      swap_light("*", question_.lights[column].spectrum, scenes[row]);
      for (const int material : question_.materials)
        swap_reflectance({material, v1::FACTOR_DIFFUSE}, question_.paints[row].spectrum,
                         scenes[row]);
    }
    std::vector<Image> pictures;
    relight(factors_, scenes, observer_, pictures);
    pictures.push_back(relight_rgb(factors_, scenes.front(), observer_));
    plan_relit(scenes.front(), plan_);
    for (std::size_t row = 0; row < pictures.size(); ++row)
      fill(made_.sheet.cells[row * question_.lights.size() + column], pictures, row);
  }

  MetamerismSheet take(std::vector<PaintMatch> matches) {
    made_.developing.adaptation = identity3;  // each picture has its own
    made_.matches = std::move(matches);
    return std::move(made_);
  }

 private:
  void fill(SheetCell& cell, const std::vector<Image>& pictures, std::size_t row) {
    if (const auto planned = planned_developing(plan_)) made_.developing = planned->developing;
    cell.picture = for_sheet(as_shown(pictures[row], made_.developing));
    if (row == 0 || plan_.source_white_size() != 3) return;
    const Xyz white = {plan_.source_white(0), plan_.source_white(1), plan_.source_white(2)};
    const auto difference = compare(pictures.front(), pictures[row], Metric::de00, white);
    if (!difference) return;
    set_difference(*difference, cell);
    cell.map = map_for_sheet(*difference);
  }

  const Factors& factors_;
  const v1::SceneFactors& scene_;
  v1::Plan plan_;
  const SheetQuestion& question_;
  Observer observer_;
  MetamerismSheet made_;
};

}  // namespace

Result<MetamerismSheet> metamerism_sheet(const Factors& factors, const v1::SceneFactors& scene,
                                         const v1::Plan& plan, const SheetQuestion& question) {
  for (const int material : question.materials)
    if (material < 0 || material >= scene.material_size())
      return problem("the picture has no such material");
  SheetMaker maker(factors, scene, plan, question);
  auto matches = match_paints(question.paints.front().spectrum,
                              {question.paints.begin() + 1, question.paints.end()}, question.lights,
                              maker.observer());
  if (!matches) return tl::unexpected(std::move(matches.error()));
  for (std::size_t column = 0; column < question.lights.size(); ++column) maker.add_column(column);
  return maker.take(std::move(*matches));
}

}  // namespace metamer::client
