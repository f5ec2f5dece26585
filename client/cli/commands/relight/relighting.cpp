#include "client/cli/commands/relight/relighting.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "client/relight/relight.h"
#include "client/tools/pictures/relit.h"

namespace metamer::cli {
namespace {

using client::relit_together;

/// How many pictures are held at once: one a thread, in 256 MiB.
std::size_t pictures_at_once(const Factors& factors) {
  const std::size_t threads = std::thread::hardware_concurrency();
  const std::size_t wanted = (threads / relit_together + 1) * relit_together;
  const std::size_t bytes = 3 * sizeof(float) * factors.end.size();
  return std::clamp<std::size_t>((std::size_t{256} << 20) / bytes, 1, wanted);
}

}  // namespace

bool Relighting::check() {
  bool good = true;
  v1::SceneFactors scene = work_.scene;
  for (const Variant& light : work_.lights) good = swapper_.swap_lights(light, scene) && good;
  for (const Variant& material : work_.materials)
    good = swapper_.swap_materials(material, scene) && good;
  return good;
}

void Relighting::make(const std::function<void(const std::vector<RelitPicture>& pictures)>& take) {
  const std::size_t count = work_.lights.size() * work_.materials.size();
  const std::size_t at_once = pictures_at_once(work_.factors);
  std::vector<Image> images;
  for (std::size_t first = 0; first < count; first += at_once) {
    std::vector<RelitPicture> pictures = swapped(first, std::min(first + at_once, count));
    relight(pictures, images);
    take(pictures);
    for (std::size_t i = 0; i < images.size(); ++i) images[i] = std::move(pictures[i].image);
  }
}

std::vector<RelitPicture> Relighting::swapped(std::size_t first, std::size_t last) {
  std::vector<RelitPicture> pictures;
  for (std::size_t i = first; i < last; ++i) {
    RelitPicture picture{.light = i / work_.materials.size(),
                         .material = i % work_.materials.size(),
                         .scene = work_.scene,
                         .plan = work_.factors.plan,
                         .image = {}};
    swapper_.swap_lights(work_.lights[picture.light], picture.scene);
    swapper_.swap_materials(work_.materials[picture.material], picture.scene);
    client::plan_relit(picture.scene, picture.plan);
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

void Relighting::relight(std::vector<RelitPicture>& pictures, std::vector<Image>& images) {
  std::vector<v1::SceneFactors> scenes;
  for (const RelitPicture& picture : pictures) scenes.push_back(picture.scene);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  client::relight(work_.factors, scenes, client::observer_of(work_.factors.plan, work_.scene),
                  images);
  milliseconds_ += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  for (std::size_t i = 0; i < images.size(); ++i) pictures[i].image = std::move(images[i]);
}

}  // namespace metamer::cli
