// How fast the tracer is, what each method costs over `rgb`, and how much of Embree's own rate is
// left, by ISA. Every figure of the table at the end is a ratio of medians of one interleaved run.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string_view>
#include <vector>

#include "common/scene/methods.h"
#include "server/cpu/renderer.h"
#include "server/cpu/tracer.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/raw_rays.h"

namespace {

using namespace metamer;

/// A scene in Embree and everything that a case needs; built once.
struct Bench {
  explicit Bench(bool mirrors, unsigned spp, const std::string& embree = "")
      : scene(bench::make_ground(176, mirrors)),
        geometry(build(scene, embree)),
        plan(bench::make_plan(scene, spp)),
        pixels(std::size_t{plan.width()} * plan.height() * 3) {}

  /// Renders the whole picture by tiles on this thread; returns the rays.
  std::uint64_t render(const Method& method) {
    const cpu::Tracer tracer(scene, geometry, plan);
    auto workspace = tracer.make_workspace();
    const Film film{pixels.data(), plan.width(), plan.height()};
    FilmSink sink(method, film, plan.spp());
    for (std::uint32_t y = 0; y < plan.height(); y += plan.tile_size())
      for (std::uint32_t x = 0; x < plan.width(); x += plan.tile_size())
        tracer.render({x, y, plan.tile_size(), plan.tile_size()}, sink, workspace, never, work);
    return workspace.rays.rays();
  }

  static cpu::EmbreeScene build(const RenderScene& scene, const std::string& embree) {
    const std::atomic<bool> never = false;
    cpu::keep_embree_to(embree);
    cpu::EmbreeScene geometry = *cpu::EmbreeScene::build(scene, never);
    cpu::keep_embree_to("");
    return geometry;
  }

  std::atomic<bool> never = false;
  std::atomic<std::uint64_t> work = 0;
  RenderScene scene;
  cpu::EmbreeScene geometry;
  v1::Plan plan;
  std::vector<float> pixels;
};

Bench& direct() {
  static Bench bench(false, 16);
  return bench;
}
Bench& direct_avx2() {
  static Bench bench(false, 16, "avx2");
  return bench;
}
Bench& direct_single() {
  static Bench bench(false, 1);
  return bench;
}
Bench& mirrors() {
  static Bench bench(true, 16);
  return bench;
}

void render(benchmark::State& state, Bench& bench, const v1::Method& choice) {
  *bench.plan.mutable_method() = choice;
  const auto method = make_method(bench.plan, bench.scene);
  std::uint64_t rays = 0;
  for (auto _ : state) rays += bench.render(*method);
  state.counters["Mrays/s"] =
      benchmark::Counter(static_cast<double>(rays) / 1e6, benchmark::Counter::kIsRate);
}

/// By the tracer of an ISA, as a worker has it, on one thread.
void render_by(benchmark::State& state, Bench& bench, cpu::Isa isa) {
  *bench.plan.mutable_method() = bench::rgb_method();
  bench.plan.set_threads(1);
  const auto method = make_method(bench.plan, bench.scene);
  cpu::keep_embree_to(isa == cpu::Isa::avx2 ? "avx2" : "");
  const auto renderer = cpu::make_backend(1, isa)->make_renderer(bench.scene, "");
  const bool changed = renderer->change(bench.plan, *method, bench.never).has_value();
  cpu::keep_embree_to("");
  if (!changed) return state.SkipWithError("the renderer refuses the scene");
  for (auto _ : state) {
    Picture picture;
    picture.film = {bench.pixels.data(), bench.plan.width(), bench.plan.height()};
    picture.samples = sample_pattern(bench.plan.spp());
    renderer->begin(std::move(picture));
    if (!renderer->draw({bench.never, [] { return false; }, bench.work}))
      state.SkipWithError("the renderer fails");
  }
  state.counters["Mrays/s"] = benchmark::Counter(
      static_cast<double>(renderer->rays().rays()) * static_cast<double>(state.iterations()) / 1e6,
      benchmark::Counter::kIsRate);
}

template <int lanes>
void raw_embree(benchmark::State& state, Bench& bench) {
  *bench.plan.mutable_method() = bench::rgb_method();
  const std::uint64_t traced = bench.render(*make_method(bench.plan, bench.scene));
  const bench::RawRays<lanes> rays(bench.scene, bench.geometry, bench.plan);
  // The last bits of a direction decide which rays meet an edge: a few in ten thousand may differ.
  if (std::abs(static_cast<double>(rays.count()) / static_cast<double>(traced) - 1) > 1e-3) {
    state.SkipWithError("the tracer did not issue the same rays");
    return;
  }
  for (auto _ : state) rays.replay(bench.geometry.handle());
  state.counters["Mrays/s"] = benchmark::Counter(
      static_cast<double>(rays.count()) * static_cast<double>(state.iterations()) / 1e6,
      benchmark::Counter::kIsRate);
}

/// What is measured, by name: "point/7", "linear/4", "exact".
std::vector<std::pair<std::string, v1::Method>> cases() {
  std::vector<std::pair<std::string, v1::Method>> all;
  for (unsigned samples : {7u, 16u, 61u, 301u, 4001u})
    all.emplace_back("point/" + std::to_string(samples), bench::point_method(samples));
  v1::Method fitted;
  fitted.mutable_point()->set_fitted(8);
  all.emplace_back("fitted/8", fitted);
  for (const MethodEntry& entry : method_entries()) {
    if (std::string_view(entry.word) == "point") continue;
    const v1::Method method = default_method(entry);
    std::string name = method_text(method);
    std::replace(name.begin(), name.end(), ' ', '/');
    all.emplace_back(name, method);
  }
  return all;
}

/// The console's usual report, and the medians for the table.
class Report : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.aggregate_name == "median")
        medians_[run.run_name.function_name] = run.GetAdjustedCPUTime();
  }

  void print_ratios() const {
    const auto ratio = [&](const std::string& a, const std::string& b) {
      if (medians_.count(a) != 0 && medians_.count(b) != 0)
        std::printf("%-28s / %-20s %6.3f\n", a.c_str(), b.c_str(), medians_.at(a) / medians_.at(b));
    };
    const auto share = [&](const std::string& whole, const std::string& part) {
      if (medians_.count(whole) != 0 && medians_.count(part) != 0)
        std::printf("%-51s %6.1f %%\n", whole.c_str(),
                    100 * medians_.at(part) / medians_.at(whole));
    };
    std::printf(
        "\ntime, relative (median CPU times of this run; the source's Table 4.2-1 has 1.13, 1.15, "
        "1.30, 1.60 for point, its Table 4.4-3 about 1.15 for four basis functions)\n");
    for (const char* group : {"direct", "direct_1spp", "mirrors"})
      for (const auto& [method, choice] : cases())
        if (method != "rgb") ratio(std::string(group) + "/" + method, std::string(group) + "/rgb");
    std::printf("\nshare of Embree's own rate for the same rays\n");
    share("direct/rgb", "direct/embree");
    share("direct/point/301", "direct/embree");
    for (const char* isa : {"avx2", "avx512"})
      share(std::string("isa/") + isa + "/rgb", std::string("isa/") + isa + "/embree");
    std::printf("\ntime by ISA, relative\n");
    for (const char* what : {"rgb", "embree"})
      ratio(std::string("isa/avx2/") + what, std::string("isa/avx512/") + what);
  }

 private:
  std::map<std::string, double> medians_;
};

void add(const std::string& group, Bench& (*bench)()) {
  const auto add_case = [&](const std::string& name, const v1::Method& method) {
    benchmark::RegisterBenchmark((group + "/" + name).c_str(), [bench, method](auto& state) {
      render(state, bench(), method);
    })->Unit(benchmark::kMillisecond);
  };
  for (const auto& [name, method] : cases()) add_case(name, method);
}

}  // namespace

int main(int count, char** arguments) {
  // Interleave the cases, so that a machine whose speed drifts favours none.
  std::vector<char*> all{arguments[0]};
  std::string defaults[] = {"--benchmark_enable_random_interleaving=true",
                            "--benchmark_repetitions=9", "--benchmark_min_time=0.2",
                            "--benchmark_report_aggregates_only=true"};
  for (std::string& option : defaults) all.push_back(option.data());
  all.insert(all.end(), arguments + 1, arguments + count);
  int all_count = static_cast<int>(all.size());
  benchmark::Initialize(&all_count, all.data());

  add("direct", direct);
  add("direct_1spp", direct_single);
  add("mirrors", mirrors);
  const auto add_one = [](const char* name, auto run) {
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond);
  };
  add_one("direct/embree", [](auto& state) { raw_embree<8>(state, direct()); });
  add_one("isa/avx2/rgb", [](auto& state) { render_by(state, direct(), cpu::Isa::avx2); });
  add_one("isa/avx2/embree", [](auto& state) { raw_embree<8>(state, direct_avx2()); });
  if (cpu::choose_isa("avx512")) {
    add_one("isa/avx512/rgb", [](auto& state) { render_by(state, direct(), cpu::Isa::avx512); });
    add_one("isa/avx512/embree", [](auto& state) { raw_embree<16>(state, direct()); });
  }
  Report report;
  benchmark::RunSpecifiedBenchmarks(&report);
  report.print_ratios();
}
