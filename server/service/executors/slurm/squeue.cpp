#include "server/service/executors/slurm/squeue.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace metamer::service {
namespace {

/// Of a name, a word or a node in a listing.
constexpr std::size_t max_text = 128;
/// Slurm's own documents have eight.
constexpr int max_depth = 32;

std::string printable_part(const std::string& text) {
  std::string part = text.substr(0, max_text);
  for (char& c : part)
    if (c < ' ' || c > '~') c = '?';
  return part;
}

/// Takes a document as it is read, so that none of it is kept but what is asked for. `jobs` is a
/// list at depth 2, its members objects at depth 3, their values at that depth or in a list or
/// object one deeper.
class SqueueReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit SqueueReader(std::string_view prefix) : prefix_(prefix) {}

  std::vector<ListedTask> tasks;
  bool has_jobs = false;
  std::string wrong;

  bool null() override { return true; }
  bool boolean(bool value) override {
    if (depth_ == 4 && field_ == "array_task_id" && key_ == "set") number_set_ = value;
    return true;
  }
  bool number_integer(number_integer_t value) override {
    if (value >= 0) return number_unsigned(static_cast<number_unsigned_t>(value));
    return true;
  }
  bool number_unsigned(number_unsigned_t value) override {
    const bool own = depth_ == 3 || (depth_ == 4 && key_ == "number");
    // 2^32 - 2 is Slurm's word for none.
    constexpr number_unsigned_t none = 0xFFFF'FFFE;
    if (in_jobs_ && own && field_ == "array_task_id" && value < none)
      task_.index = static_cast<std::uint32_t>(value);
    return true;
  }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& value) override {
    if (!in_jobs_ || depth_ < 3 || depth_ > 4) return true;
    if (depth_ == 3 && field_ == "name") task_.name = value;
    if (depth_ == 3 && field_ == "nodes") task_.node = printable_part(value);
    if (depth_ == 3 && field_ == "array_task_string") whole_array_ = !value.empty();
    if (field_ == "job_state" && task_.word.empty()) task_.word = printable_part(value);
    return true;
  }
  bool key(string_t& name) override {
    if (depth_ <= 3) field_ = name.substr(0, max_text);
    key_ = name.substr(0, max_text);
    return true;
  }
  bool start_array(std::size_t) override {
    if (depth_ == 1 && field_ == "jobs") in_jobs_ = has_jobs = true;
    return enter();
  }
  bool end_array() override {
    if (--depth_ == 1) in_jobs_ = false;
    return true;
  }
  bool start_object(std::size_t) override {
    if (in_jobs_ && depth_ == 2) {
      task_ = {};
      whole_array_ = false;
      number_set_ = true;
    }
    return enter();
  }
  bool end_object() override {
    if (--depth_ == 2 && in_jobs_) return add();
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    if (wrong.empty()) wrong = "is no JSON";
    return false;
  }

 private:
  bool enter() {
    if (++depth_ > max_depth) wrong = "is nested too deep";
    return depth_ <= max_depth;
  }
  bool add() {
    if (!std::string_view(task_.name).starts_with(prefix_) || task_.name.size() > max_text)
      return true;
    if (whole_array_ || !number_set_) task_.index.reset();
    task_.state = state_of(task_.word);
    tasks.push_back(std::move(task_));
    if (tasks.size() > max_listed) wrong = "lists more tasks than can be ours";
    return tasks.size() <= max_listed;
  }

  std::string_view prefix_;
  int depth_ = 0;
  bool in_jobs_ = false;
  std::string field_, key_;  // of the object at depth 3, and the last one
  ListedTask task_;
  bool whole_array_ = false;  // it stands for those of its array that wait
  bool number_set_ = true;
};

}  // namespace

ListedTask::State state_of(std::string_view word) {
  using State = ListedTask::State;
  constexpr std::string_view waiting[] = {"PENDING",      "REQUEUED",      "REQUEUE_FED",
                                          "REQUEUE_HOLD", "RESV_DEL_HOLD", "SPECIAL_EXIT"};
  constexpr std::string_view ended[] = {"BOOT_FAIL", "CANCELLED", "COMPLETED",     "DEADLINE",
                                        "FAILED",    "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED",
                                        "REVOKED",   "TIMEOUT"};
  if (std::find(std::begin(waiting), std::end(waiting), word) != std::end(waiting))
    return State::waiting;
  const bool is_over = std::find(std::begin(ended), std::end(ended), word) != std::end(ended);
  return is_over ? State::ended : State::running;
}

Result<std::vector<ListedTask>> read_squeue(std::string_view json, std::string_view prefix) {
  SqueueReader reader(prefix);
  if (!nlohmann::json::sax_parse(json.begin(), json.end(), &reader))
    return problem("what squeue says " + (reader.wrong.empty() ? "is no JSON" : reader.wrong));
  if (!reader.has_jobs) return problem("what squeue says has no list of jobs");
  return std::move(reader.tasks);
}

}  // namespace metamer::service
