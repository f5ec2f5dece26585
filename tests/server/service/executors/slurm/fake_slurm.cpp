#include "fake_slurm.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>

namespace metamer::service::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* sbatch = R"(#!/bin/sh
cd "$METAMER_TEST_SLURM" || exit 1
[ -e down ] && { echo 'Unable to contact slurm controller' >&2; exit 1; }
[ -e refuse ] && { echo 'sbatch: error: Batch job submission failed: Invalid account' >&2; exit 1; }
[ -e words ] || echo "$*" > words
for word; do
  case $word in
    --job-name=*) name=${word#--job-name=} ;;
    --array=*) last=${word#--array=0-} ;;
    --output=*) log=${word#--output=} ;;
  esac
done
cat > "script.$name"
[ -e script ] || cp "script.$name" script
[ -e speechless ] && printf 'echo "metamer-worker: the disk is full\007" >&2; exit 1\n' > "script.$name"
i=0
while [ $i -le $last ]; do
  echo x >> submitted
  if [ ! -e forget ]; then
    echo PENDING > "state.$name.$i"
    (
      while [ -e hold ]; do sleep 0.02; done
      echo RUNNING > "state.$name.$i"
      [ -e nothing ] || SLURM_ARRAY_TASK_ID=$i SLURMD_NODENAME=fake1 sh "script.$name" > "${log%\%a.log}$i.log" 2>&1
      [ $? -eq 0 ] && echo COMPLETED > "state.$name.$i" || echo FAILED > "state.$name.$i"
    ) > /dev/null 2>&1 < /dev/null &
  fi
  i=$((i + 1))
done
echo 7
)";

constexpr const char* squeue = R"(#!/bin/sh
cd "$METAMER_TEST_SLURM" || exit 1
[ -e down ] && { echo 'Unable to contact slurm controller' >&2; exit 1; }
printf '{"meta":{"jobs":[1]},"errors":[],"jobs":['
comma=
for file in state.*; do
  [ -e "$file" ] || continue
  read word < "$file"
  index=${file##*.}
  name=${file#state.}
  printf '%s{"job_id":7,"name":"%s","job_state":"%s","nodes":"fake1","array_task_id":%s,"array_task_string":""}' \
    "$comma" "${name%.*}" "$word" "$index"
  comma=,
done
echo ']}'
)";

constexpr const char* scancel = R"(#!/bin/sh
cd "$METAMER_TEST_SLURM" || exit 1
[ -e down ] && { echo 'Unable to contact slurm controller' >&2; exit 1; }
for word; do
  case $word in --name=*) name=${word#--name=} ;; esac
done
echo "$name" >> cancelled
for file in "state.$name".*; do
  [ -e "$file" ] && echo CANCELLED > "$file"
done
exit 0
)";

void write_program(const fs::path& file, const char* text) {
  std::ofstream(file) << text;
  fs::permissions(file, fs::perms::owner_all);
}

std::size_t lines_of(const fs::path& file) {
  std::ifstream in(file);
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n'));
}

}  // namespace

FakeSlurm::FakeSlurm() : path_before_(::getenv("PATH")) {
  std::string path = "/tmp/metamer-slurm-XXXXXX";
  folder_ = ::mkdtemp(path.data());
  write_program(folder_ / "sbatch", sbatch);
  write_program(folder_ / "squeue", squeue);
  write_program(folder_ / "scancel", scancel);
  ::setenv("PATH", (folder_.string() + ":" + path_before_).c_str(), 1);
  ::setenv("METAMER_TEST_SLURM", folder_.c_str(), 1);
}

FakeSlurm::~FakeSlurm() {
  take_back("hold");
  ::setenv("PATH", path_before_.c_str(), 1);
  ::unsetenv("METAMER_TEST_SLURM");
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void FakeSlurm::say(const std::string& word) const { std::ofstream(folder_ / word).put('x'); }
void FakeSlurm::take_back(const std::string& word) const { fs::remove(folder_ / word); }
std::size_t FakeSlurm::submitted() const { return lines_of(folder_ / "submitted"); }
std::size_t FakeSlurm::cancelled() const { return lines_of(folder_ / "cancelled"); }

std::string FakeSlurm::first_words() const {
  std::ifstream in(folder_ / "words");
  std::string line;
  std::getline(in, line);
  return line;
}

std::string FakeSlurm::first_script() const {
  std::ifstream in(folder_ / "script");
  return {std::istreambuf_iterator<char>(in), {}};
}

void FakeSlurm::list_stranger(const std::string& name) const {
  std::ofstream(folder_ / ("state." + name + ".0")) << "RUNNING\n";
}

bool FakeSlurm::was_cancelled(const std::string& name) const {
  std::ifstream in(folder_ / "cancelled");
  for (std::string line; std::getline(in, line);)
    if (line == name) return true;
  return false;
}

}  // namespace metamer::service::test
