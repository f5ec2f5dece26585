#include "client/tools/series/series_list.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "client/tools/series/series_run.h"
#include "client/tools/text/formatted.h"
#include "client/tools/text/job_text.h"
#include "common/printable.h"

namespace metamer::client {
namespace {

constexpr std::string_view series_prefix = "series:";
constexpr std::size_t least_series_digits = 6;
constexpr std::size_t most_places = 3;

void count_job(const v1::JobSummary& job, ListedSeries& series) {
  switch (job.state()) {
    case v1::QUEUED:
      ++series.queued;
      break;
    case v1::RUNNING:
      ++series.running;
      break;
    case v1::PAUSED:
      ++series.paused;
      break;
    case v1::FINISHED:
      ++series.finished;
      break;
    case v1::FAILED:
      ++series.failed;
      break;
    case v1::CANCELLED:
      ++series.cancelled;
      break;
    default:  // of a newer server
      break;
  }
  series.age = std::max(series.age, job.age());
  const bool says = job.state() == v1::RUNNING && !job.reason().empty();
  if (says &&
      std::find(series.places.begin(), series.places.end(), job.reason()) == series.places.end())
    series.places.push_back(job.reason());
}

/// "partial": nothing of it runs or waits, and not all was submitted. Who submits it is about to
/// send the next one, or gone.
const char* state_word(const ListedSeries& series) {
  if (series.running > 0) return word(v1::RUNNING);
  if (series.paused > 0) return word(v1::PAUSED);
  if (series.queued > 0) return word(v1::QUEUED);
  if (series.failed > 0) return word(v1::FAILED);
  if (series.cancelled > 0) return word(v1::CANCELLED);
  return series.to_come > 0 ? "partial" : word(v1::FINISHED);
}

/// "2 running on n1; 1 failed"
std::string details(const ListedSeries& series) {
  std::string text;
  const auto add = [&](std::uint32_t count, const std::string& words) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + ' ' + words;
  };
  std::string where;
  for (std::size_t i = 0; i < std::min(most_places, series.places.size()); ++i)
    where += (i == 0 ? ": " : ", ") + printable(series.places[i]);
  if (series.places.size() > most_places) where += ", …";
  add(series.running, "running" + where);
  add(series.queued, "queued");
  add(series.paused, "paused");
  add(series.failed, "failed");
  add(series.cancelled, "cancelled");
  add(series.gone, "not listed");
  add(series.to_come, "not submitted");
  return text;
}

bool is_live(const ListedSeries* series) { return series->live() > 0; }

}  // namespace

std::vector<ListedSeries> listed_series(const v1::JobList& list) {
  std::vector<ListedSeries> all;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  std::vector<std::set<std::uint32_t>> indices;
  for (const v1::JobSummary& job : list.job()) {
    if (!job.has_series()) continue;
    // An id that two users have chosen, whoever meant whom, is two series.
    const auto [place, is_new] = places.try_emplace({job.user(), job.series().id()}, all.size());
    if (is_new) {
      ListedSeries& made = all.emplace_back();
      made.series = job.series();
      made.user = job.user();
      made.backend = job.backend();
      indices.emplace_back();
    }
    count_job(job, all[place->second]);
    indices[place->second].insert(job.series().index());
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint64_t before_next = std::uint64_t{*indices[i].rbegin()} + 1;
    all[i].gone = static_cast<std::uint32_t>(before_next - indices[i].size());
    if (all[i].series.count() > before_next)
      all[i].to_come = all[i].series.count() - static_cast<std::uint32_t>(before_next);
  }
  return all;
}

std::string describe(const ListedSeries& series) {
  const std::string user = series.user.empty() ? "-" : printable(series.user);
  const std::string more = details(series);
  return formatted("%16s  %-9s  %11s  %8s  %-3s  ", series_handle(series.series.id()).c_str(),
                   state_word(series),
                   formatted("%u of %u", series.finished, series.series.count()).c_str(),
                   clock(series.age).c_str(), series.backend == v1::GL ? "gl" : "cpu") +
         user + "  " + printable(series.series.name()) + (more.empty() ? "" : "  (" + more + ")");
}

bool names_series(const std::string& word) { return word.starts_with(series_prefix); }

Result<ListedSeries> find_series(const std::vector<ListedSeries>& listed, const std::string& word) {
  const std::string named = word.substr(series_prefix.size());
  std::string digits = named;
  std::transform(digits.begin(), digits.end(), digits.begin(), [](char c) {
    return 'A' <= c && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  std::vector<const ListedSeries*> found;
  for (const ListedSeries& one : listed)
    if (one.series.name() == named || (digits.size() >= least_series_digits &&
                                       series_digits(one.series.id()).starts_with(digits)))
      found.push_back(&one);
  if (found.empty())
    return problem("no series " + quoted(named) + " has jobs that are listed here");
  if (found.size() > 1 && std::any_of(found.begin(), found.end(), is_live))
    std::erase_if(found, std::not_fn(is_live));
  if (found.size() == 1) return *found.front();
  std::string text = "several series are called " + quoted(named) + ":";
  for (const ListedSeries* one : found) text += ' ' + series_handle(one->series.id());
  return problem(text);
}

}  // namespace metamer::client
