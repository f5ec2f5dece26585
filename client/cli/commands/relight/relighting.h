#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/commands/relight/variants.h"
#include "client/cli/exit_code.h"
#include "client/cli/shared_options.h"
#include "common/image/image.h"

/// The pictures that are made of one file of factors.
namespace metamer::cli {

struct RelightOptions {
  bool json = false;
  std::string file;                    ///< What --keep-factors wrote.
  std::vector<std::string> lights;     ///< "ceiling=F11", "*=lamp.txt", "key=lamps.sp#warm"
  std::vector<std::string> materials;  ///< "door=red.sp", "door.specular=gloss.txt"
  std::optional<std::string> observer;
  std::string sheet;        ///< A .png of all pictures; empty: none.
  bool sheet_maps = false;  ///< With a map of the differences below each.
  DevelopmentOptions development;
  OutputOptions output;
};

/// All that is made of one file of factors.
struct RelightWork {
  Factors factors;  ///< Its plan has the observer and the development that the options say.
  v1::SceneFactors scene;
  std::vector<Variant> lights, materials;
};

/// One of the pictures.
struct RelitPicture {
  std::size_t light, material;  ///< Its variants.
  v1::SceneFactors scene;
  v1::Plan plan;
  Image image;  ///< X Y Z.
};

/// Makes the pictures of each light after the other, some at a time on all threads, and hands them
/// on in this order.
class Relighting {
 public:
  Relighting(const RelightWork& work, Report& report)
      : work_(work), swapper_(work.factors, report) {}

  /// Lets every spectrum be read before any picture is made. False: one can't be, which is said.
  bool check();
  /// `take` gets a few pictures at a time.
  void make(const std::function<void(const std::vector<RelitPicture>& pictures)>& take);
  double milliseconds() const { return milliseconds_; }

 private:
  /// What the pictures are made of.
  std::vector<RelitPicture> swapped(std::size_t first, std::size_t last);
  /// Makes them, in the memory of `images`.
  void relight(std::vector<RelitPicture>& pictures, std::vector<Image>& images);

  const RelightWork& work_;
  Swapper swapper_;
  double milliseconds_ = 0;
};

}  // namespace metamer::cli
