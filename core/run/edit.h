#pragma once
// Edits: visits that a person makes a run do between its own. A run's path is its input, the visits in their order, and its edits at their
// moments: following it again gives the same bits.

#include <cstddef>
#include <vector>

#include "core/base/shared_vector.h"
#include "core/mesh/mesh.h"
#include "core/run/moment.h"

namespace dmoscope {

/// Visits of chosen vertices out of their turn.
struct Edit {
  static constexpr std::size_t kMostVertices = 4096;  // so that no edit takes long: more of them are several edits

  Moment at;                      // moment before the edit; afterwards the run stands at the same place with one edit more
  std::vector<Index> vertices{};  // free vertices, in the order in which an iteration visits them
  friend bool operator==(const Edit&, const Edit&) = default;
};

/// The edits of a run's path, in the order of their moments.
class Edits {
 public:
  [[nodiscard]] const std::vector<Edit>& all() const noexcept { return edits_.values(); }
  [[nodiscard]] SharedVector<Edit> share() const { return edits_.share(); }
  /// Edit to be done at this very moment; null: none.
  [[nodiscard]] const Edit* at(const Moment& moment) const;
  /// First edit after this moment; null: none.
  [[nodiscard]] const Edit* after(const Moment& moment) const;
  /// Number of edits at a place, whatever its own `edits` says.
  [[nodiscard]] std::uint64_t count_at(const Moment& place) const;
  /// Number of edits before or at a moment.
  [[nodiscard]] std::size_t done_by(const Moment& moment) const;

  /// Forgets the edits from this moment on.
  void cut(const Moment& moment);
  /// Appends an edit after all others.
  void add(Edit edit) { edits_.change().push_back(std::move(edit)); }
  void replace(const SharedVector<Edit>& edits) { edits_.replace(edits.whole()); }

 private:
  GrowingVector<Edit> edits_;
};

}  // namespace dmoscope
