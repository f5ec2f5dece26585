#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace metamer::service {

/// The seconds that workers spent on each user's jobs within the last day, by the hours of the
/// clock: the hour that it is and the 23 before. What was spent is forgotten at the full hour, a
/// day later at most. Times are seconds since 1970.
class WorkLedger {
 public:
  static constexpr std::int64_t hours = 24;

  /// What was spent on a user in one hour, of those since 1970.
  struct Entry {
    std::string user;
    std::int64_t hour = 0;
    double seconds = 0;
  };

  void spend(std::string_view user, double seconds, double now);
  double spent(std::string_view user, double now) const;
  /// Of each user on whose jobs any was.
  std::map<std::string, double> all_spent(double now) const;
  /// The full hour at which the user will have had less than `most`, if it gets nothing until then;
  /// nothing: it has now. `most` above 0.
  std::optional<double> free_at(std::string_view user, double most, double now) const;

  /// Those that have changed since this was asked last; what is older than the day is forgotten.
  std::vector<Entry> take_changes(double now);
  /// The first hour that counts.
  static std::int64_t first_hour(double now);
  /// As it was kept.
  void restore(const std::vector<Entry>& kept);

 private:
  struct Hour {
    double seconds = 0;
    bool changed = false;
  };
  using Hours = std::map<std::int64_t, Hour>;

  std::map<std::string, Hours, std::less<>> users_;
};

}  // namespace metamer::service
