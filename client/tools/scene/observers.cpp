#include "client/tools/scene/observers.h"

#include <filesystem>
#include <utility>

#include "client/tools/scene/words.h"
#include "common/scene/files.h"
#include "common/scene/settings.h"
#include "common/spectral/files/encoding.h"
#include "common/spectral/files/observer_file.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer::client {

Result<ChosenObserver> choose_observer(const std::string& word) {
  auto named = observer_named(word);
  if (named) return ChosenObserver{*named, {}};
  std::error_code error;
  if (std::filesystem::exists(word, error)) return ChosenObserver{v1::CIE_1931_2DEG, word};
  if (word.find_first_of("./") != std::string::npos)
    return problem("file " + quoted(word) + " does not exist");
  named.error().message += "; and there is no such file";
  return tl::unexpected(std::move(named.error()));
}

SpectrumResult<Observer> load_observer(const std::string& word) {
  const auto chosen = choose_observer(word);
  if (!chosen)
    return tl::unexpected(SpectrumFault{.problem = chosen.error(), .source = {}, .choice = true});
  if (chosen->file.empty()) return to_observer(chosen->cie);
  Result<std::string> text = read_file(word, max_spectrum_file);
  if (!text) return tl::unexpected(SpectrumFault{.problem = std::move(text.error())});
  Result<Observer> observer = parse_observer(*text, word);
  if (!observer)
    return tl::unexpected(SpectrumFault{.problem = std::move(observer.error()),
                                        .source = utf8_text(*text, word).value_or(*text)});
  return *std::move(observer);
}

}  // namespace metamer::client
