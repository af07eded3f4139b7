#include "core/mesh/assemble.h"

#include <algorithm>

namespace oversketch {

namespace {

constexpr double kHalf = 0.5;

class Trimmer {
public:
  explicit Trimmer(const CellCopies& copies) : c_(copies), kept_(static_cast<std::size_t>(copies.copy_count()), true) {}

  std::vector<bool> run() {
    std::vector<int> candidates;
    for (int i = 0; i < c_.copy_count(); ++i)
      if (c_.copies[i].coverage < kHalf && has_stable_neighbour(i)) candidates.push_back(i);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](int a, int b) { return c_.copies[a].coverage < c_.copies[b].coverage; });
    // Leaving one out can free another one that was needed to hold it.
    for (bool changed = true; changed;) {
      const auto rest =
          std::stable_partition(candidates.begin(), candidates.end(), [&](int i) { return !leave_out(i); });
      changed = rest != candidates.end();
      candidates.erase(rest, candidates.end());
    }
    return std::move(kept_);
  }

private:
  bool leave_out(int copy) {
    if (attachments(copy) != 1) return false;
    kept_[copy] = false;
    return true;
  }

  int neighbour(int port) const { return c_.ports[c_.ports[port].twin].copy; }

  bool has_stable_neighbour(int copy) const {
    for (int port = c_.copies[copy].first_port; port < c_.copies[copy + 1].first_port; ++port)
      if (c_.copies[neighbour(port)].coverage >= kHalf) return true;
    return false;
  }

  /// Unbroken parts of the copy's border along which kept copies lie; 0 when they lie all round it.
  int attachments(int copy) const {
    int count = 0;
    for (int port = c_.copies[copy].first_port; port < c_.copies[copy + 1].first_port; ++port) {
      if (!kept_[neighbour(port)]) continue;
      ++count;
      if (c_.ports[port].inside_corner && kept_[neighbour(c_.next_port(port))] && kept_[across_corner(port)]) --count;
    }
    return count;
  }

  /// The fourth copy round the inside corner that follows a port.
  int across_corner(int port) const { return neighbour(c_.previous_port(c_.ports[port].twin)); }

  const CellCopies& c_;
  std::vector<bool> kept_;
};

} // namespace

std::vector<bool> trim(const CellCopies& copies) {
  return Trimmer(copies).run();
}

} // namespace oversketch
