// Runs a fuzz target over its seeds, and over mutations of them that are the same each time: what
// every build with the address sanitizer can do without libFuzzer.
//
//     frame_mutations SEEDS COUNT LAST
//
// The input that breaks the target is written to LAST.

#include <sys/time.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" __attribute__((weak)) int LLVMFuzzerInitialize(int* count, char*** arguments);

// Of sanitizer/common_interface_defs.h, which Debian has for Clang alone.
extern "C" void __sanitizer_set_death_callback(void (*callback)());

namespace {

constexpr int longest = 10;                   ///< Seconds of the processor that one input may take.
constexpr std::size_t largest_input = 16384;  ///< Bytes; seeds are small.

std::vector<std::string> read_seeds(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const auto& file : files) {
    std::ifstream from(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(from), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Mutations {
 public:
  explicit Mutations(const std::vector<std::string>& seeds) : seeds_(seeds) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    for (std::size_t edits = 1 + below(6); edits > 0; --edits) edit(text);
    text.resize(std::min(text.size(), largest_input));
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }
  char byte() {
    static constexpr char telling[] = "\0\1\x7f\x80\xff\n\r\t ,;.-+eE\"{}[]:0129";
    return below(2) == 0 ? telling[below(sizeof telling)] : static_cast<char>(below(256));
  }

  void edit(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min(text.size() - at, below(1 + (std::size_t{1} << below(9))));
    const std::string piece = text.substr(at, length);
    const std::string& other = seeds_[below(seeds_.size())];
    switch (below(7)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        if (at < text.size()) text[at] = byte();
        break;
      case 2:
        text.insert(at, 1 + below(4), byte());
        break;
      case 3:
        text.erase(at, length);
        break;
      case 4:
        text.insert(below(text.size() + 1), piece);
        break;
      case 5:
        text.replace(at, length, other.substr(below(other.size()), 1 + below(200)));
        break;
      case 6:
        text.resize(at);
        break;
    }
  }

  const std::vector<std::string>& seeds_;
  std::mt19937 random_{1};
};

const char* last = nullptr;
const std::string* running = nullptr;

void keep_input() {
  if (running == nullptr) return;
  std::ofstream(last, std::ios::binary) << *running;
  std::fprintf(stderr, "the input is in %s\n", last);
}
/// Of an abort, and of an input that takes too long.
void end(int) {
  keep_input();
  std::_Exit(1);
}

void run(const std::string& input) {
  running = &input;
  // Not by the clock: other tests may run beside this one.
  const itimerval limit{{}, {longest, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  running = nullptr;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::fprintf(stderr, "usage: %s SEEDS COUNT LAST\n", arguments[0]);
    return 2;
  }
  if (LLVMFuzzerInitialize != nullptr) LLVMFuzzerInitialize(&count, &arguments);
  const std::vector<std::string> seeds = read_seeds(arguments[1]);
  if (seeds.empty()) return 2;
  last = arguments[3];
  __sanitizer_set_death_callback(keep_input);
  std::signal(SIGABRT, end);
  std::signal(SIGPROF, end);
  for (const std::string& seed : seeds) run(seed);
  Mutations mutations(seeds);
  const int wanted = std::atoi(arguments[2]);
  for (int i = 0; i < wanted; ++i) run(mutations.next());
  setitimer(ITIMER_PROF, nullptr, nullptr);
  std::printf("%zu seeds and %d mutations\n", seeds.size(), wanted);
  return 0;
}
