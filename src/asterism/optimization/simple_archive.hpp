// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>
namespace asterism {
class SimpleArchive {
 public:
  explicit SimpleArchive(std::size_t m) : m_(m) {}
  struct Member {
    std::vector<double> f;
    std::size_t index;
  };
  bool add(std::span<const double> f, std::size_t index) {
    if (m_ == 2) {
      auto it =
          std::lower_bound(two_.begin(), two_.end(), f[0], [](const Two& t, double x) { return t.a < x; });
      if (it != two_.begin() && std::prev(it)->b <= f[1]) return false;
      if (it != two_.end() && it->a == f[0] && it->b <= f[1]) return false;
      auto last = it;
      while (last != two_.end() && last->b >= f[1]) ++last;
      if (last == it) {
        two_.insert(it, {f[0], f[1], index});
      } else {
        *it = {f[0], f[1], index};
        two_.erase(it + 1, last);
      }
      return true;
    }
    for (auto& x : members_) {
      bool dom = true;
      for (std::size_t k = 0; k < m_; ++k) dom = dom && x.f[k] <= f[k];
      if (dom) return false;
    }
    std::erase_if(members_, [&](const Member& x) {
      for (std::size_t k = 0; k < m_; ++k)
        if (f[k] > x.f[k]) return false;
      return true;
    });
    members_.push_back({{f.begin(), f.end()}, index});
    return true;
  }
  std::vector<Member> members() const {
    if (m_ != 2) return members_;
    std::vector<Member> r;
    for (auto& t : two_) r.push_back({{t.a, t.b}, t.index});
    return r;
  }
  std::size_t size() const { return m_ == 2 ? two_.size() : members_.size(); }
  void clear() {
    two_.clear();
    members_.clear();
  }

 private:
  struct Two {
    double a, b;
    std::size_t index;
  };
  std::size_t m_;
  std::vector<Two> two_;
  std::vector<Member> members_;
};
}  // namespace asterism
