#pragma once

#include <map>
#include <utility>

namespace metamer::worker {

/// What a scene has made of its files, by what decides it: the next scene takes what it needs of
/// that as it is.
template <class Key, class Value>
class Known {
 public:
  bool has(const Key& key) const { return entries_.contains(key); }
  /// Null: it is not known.
  const Value* ask(const Key& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return nullptr;
    found->second.asked = true;
    return &found->second.value;
  }
  /// As if it were asked for, too.
  const Value& add(const Key& key, Value value) {
    return entries_.insert_or_assign(key, Entry{std::move(value)}).first->second.value;
  }
  /// Forgets what was not asked for since it was last called.
  void keep_asked() {
    std::erase_if(entries_, [](const auto& entry) { return !entry.second.asked; });
    for (auto& [key, entry] : entries_) entry.asked = false;
  }

 private:
  struct Entry {
    Value value;
    bool asked = true;
  };
  std::map<Key, Entry> entries_;
};

}  // namespace metamer::worker
