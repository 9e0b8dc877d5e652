#pragma once
// What a person does to a run between its visits. A run's path is its input, the visits in their order, and its edits at their moments:
// whoever follows it again finds the same bits.

#include <cstddef>
#include <vector>

#include "core/base/shared_vector.h"
#include "core/mesh/mesh.h"
#include "core/run/moment.h"

namespace dmoscope {

/// Visits of chosen vertices out of their turn.
struct Edit {
  static constexpr std::size_t kMostVertices = 4096;  // so that no edit takes long: more of them are several edits

  Moment at;                      // before it; afterwards the run stands at the same place with one edit more
  std::vector<Index> vertices{};  // free ones, in the order in which an iteration visits them
  friend bool operator==(const Edit&, const Edit&) = default;
};

/// The edits of a run's path, in the order of their moments.
class Edits {
 public:
  [[nodiscard]] const std::vector<Edit>& all() const noexcept { return edits_.values(); }
  [[nodiscard]] SharedVector<Edit> share() const { return edits_.share(); }
  /// The one to be done at this very moment; null: none.
  [[nodiscard]] const Edit* at(const Moment& moment) const;
  /// The first one after this moment; null: none.
  [[nodiscard]] const Edit* after(const Moment& moment) const;
  /// How many are done at a place (of which `edits` does not count).
  [[nodiscard]] std::uint64_t count_at(const Moment& place) const;
  /// How many are done before or at a moment.
  [[nodiscard]] std::size_t done_by(const Moment& moment) const;

  /// Forgets those from this moment on.
  void cut(const Moment& moment);
  /// To be done after all there are.
  void add(Edit edit) { edits_.change().push_back(std::move(edit)); }
  void replace(const SharedVector<Edit>& edits) { edits_.replace(edits.whole()); }

 private:
  GrowingVector<Edit> edits_;
};

}  // namespace dmoscope
