#pragma once
// Those that keep something up to date with a diagram under change.

#include <algorithm>
#include <vector>

namespace fpo {

/// Is told each change right after it is made, while what it names can be read.
template <class Change>
class Follower {
 public:
  Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  virtual ~Follower() = default;
  virtual void follow(const Change& change) = 0;
};

/// Told in the order in which they came.
template <class Change>
class Followers {
 public:
  void add(Follower<Change>& follower) { all_.push_back(&follower); }
  void remove(Follower<Change>& follower) { std::erase(all_, &follower); }
  void tell(const Change& change) const {
    for (Follower<Change>* follower : all_) follower->follow(change);
  }

 private:
  std::vector<Follower<Change>*> all_;
};

}  // namespace fpo
