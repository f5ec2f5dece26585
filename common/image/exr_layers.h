#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/image/read_exr.h"

/// Where in an EXR the picture is: among parts, and among layers, whose channels have a name before
/// the last point ("diffuse.R").
namespace metamer {

/// Which of several pictures in a file is meant; nothing: the one that is the picture by its name.
struct PictureChoice {
  std::optional<std::string> part = {};   ///< As the file or in other letters' case names it.
  std::optional<std::string> layer = {};  ///< "": the channels without a layer.
};

/// Channels that are a colour together.
struct ExrLayer {
  enum class Kind { xyz, rgb, grey, spectral };
  std::size_t part = 0;
  std::string layer;  ///< "diffuse", "ViewLayer.Combined"; empty: names without a point.
  Kind kind = Kind::rgb;
  std::vector<std::string> channels;    ///< Three; of grey Y; of spectra all, by the alphabet.
  std::string alpha = {};               ///< Its channel; empty: none.
  std::vector<std::string> aside = {};  ///< Channels of another colour: a preview, RY and BY.
};

/// All that could be meant, in the file's order.
std::vector<ExrLayer> find_layers(const std::vector<ExrPart>& parts);

/// `part "C", layer "diffuse"`, as far as the file has more than one or gives it a name; else "".
std::string name_of(const ExrLayer& layer, const std::vector<ExrPart>& parts);

/// What is taken, and what is to be said of that.
struct ChosenLayer {
  ExrLayer layer;
  bool by_choice = false;          ///< The choice had a part in it.
  std::vector<std::string> notes;  ///< What was passed over.
};

/// The layer that is meant: the only one there is, or the only one whose name, or whose part's,
/// means the picture ("", "C", "rgba", "beauty", "Combined", in any case). A file of one part that
/// has no name is meant by any part, and channels without a layer, if there are no others, by any
/// layer. Spectra beside an R G B of the same layer are the picture, and that is their preview.
/// Errors: nothing that is a colour, several that could be meant, a choice that the file has not;
/// each lists what there is.
Result<ChosenLayer> choose_layer(const std::vector<ExrPart>& parts, const PictureChoice& choice);

}  // namespace metamer
