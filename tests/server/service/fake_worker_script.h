#pragma once

#include <cstdint>
#include <map>
#include <sstream>
#include <string>

namespace metamer::service::test {

/// What the fake worker does with a job; the text of the job's scene, words apart by blanks:
///
///     picture W H T   plan a picture of W by H pixels in tiles of T (default 64 48 16)
///     gate N          after N tiles wait for a byte in the FIFO `gate` beside the store
///     reach HEX       enter the sandbox, and answer Failed with what is to be had of the assets
///     slander         say that its scene is damaged
///     crash N         abort after N tiles
///     exit N          exit with code 3 after N tiles
///     hang N          after N tiles neither render nor beat any more
///     stall N         after N tiles beat on, and render no more
///     swell N         after N tiles ask for memory until there is none, or 64 GiB are
///     deaf            do not answer StopJob
///     garbage N       after N tiles send bytes that are no frame
///     stray           send a tile that is none of the job's
///     early           say JobDone before the last tile
///     shrink          try to truncate the shared memory before the first TileDone
///     stages          say what is being prepared, and when it is there
///     prepared N      after N tiles say that all is prepared
///     preparing N     after N tiles say that more is
///     fail            answer Failed BAD_INPUT
///     broken          the promise is broken, until `exact` is asked for
///     verify          plan a check of the picture; it is kept if the memory holds all of it
///     factors N       send N bytes of factors for the scene, and N for each tile
///     shown           answer the opening of a view with the plan of its picture
///     once            all of that in the first attempt only
struct Script {
  std::uint32_t width = 64;
  std::uint32_t height = 48;
  std::uint32_t tile = 16;
  std::string reach;                        // an asset of somebody else's
  std::map<std::string, std::uint32_t> at;  // a trouble, and after how many tiles it comes

  bool has(const std::string& word) const { return at.contains(word); }
};

inline Script parse(const std::string& text) {
  Script script;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word == "picture") {
      words >> script.width >> script.height >> script.tile;
    } else if (word == "reach") {
      words >> script.reach;
    } else if (word == "gate" || word == "prepared" || word == "preparing" || word == "crash" ||
               word == "exit" || word == "hang" || word == "stall" || word == "garbage" ||
               word == "swell" || word == "factors") {
      words >> script.at[word];
    } else {
      script.at[word] = 0;
    }
  }
  return script;
}

}  // namespace metamer::service::test
