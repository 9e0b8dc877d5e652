#pragma once
// The processes of an MPI job, called ranks, and their communication.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <mpi.h>

#include "core/base/box.h"
#include "core/base/error.h"

namespace dmoscope {

/// MPI itself: one a program, made first and destroyed last.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  /// Ends all ranks at once, with this exit code: after an error of which the others cannot be told.
  [[noreturn]] static void abort(int exit_code);
};

/// Error of one rank that all ranks throw: what() tells the rank.
class SharedError : public Error {
 public:
  SharedError(const std::string& what, int exit_code) : Error(what), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const noexcept override { return exit_code_; }

 private:
  int exit_code_;
};

/// Consecutive ranges of numbers, one a rank: rank r has [begin(r), end(r)) of size().
class Ranges {
 public:
  Ranges() = default;
  explicit Ranges(std::span<const std::uint64_t> counts);
  /// Deals `size` things out as evenly as multiples of `grain` can be.
  Ranges(std::uint64_t size, int ranks, std::uint64_t grain = 1);
  [[nodiscard]] std::uint64_t begin(int rank) const noexcept { return begin_[static_cast<std::size_t>(rank)]; }
  [[nodiscard]] std::uint64_t end(int rank) const noexcept { return begin_[static_cast<std::size_t>(rank) + 1]; }
  [[nodiscard]] std::uint64_t count(int rank) const noexcept { return end(rank) - begin(rank); }
  [[nodiscard]] std::uint64_t size() const noexcept { return begin_.back(); }
  /// The rank that has thing i.
  [[nodiscard]] int holder(std::uint64_t i) const noexcept;

 private:
  std::vector<std::uint64_t> begin_{0};
};

/// Types that are sent as bytes.
template <class T>
concept Plain = std::is_trivially_copyable_v<T>;

/// Parts for each rank, one after the other: part r is [offsets[r], offsets[r + 1]).
template <Plain T>
struct Parts {
  std::vector<T> values;
  std::vector<std::uint64_t> offsets;
  [[nodiscard]] std::span<const T> of(int rank) const {
    const auto r = static_cast<std::size_t>(rank);
    return {values.data() + offsets[r], values.data() + offsets[r + 1]};
  }
};

/// A group of ranks, which all call the same functions in the same order. A view: its communicator is freed by its maker.
class World {
 public:
  explicit World(MPI_Comm comm = MPI_COMM_WORLD);
  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] bool is_first() const noexcept { return rank_ == 0; }
  [[nodiscard]] MPI_Comm comm() const noexcept { return comm_; }

  void wait_for_all() const { MPI_Barrier(comm_); }
  [[nodiscard]] double sum(double here) const { return reduced(here, MPI_DOUBLE, MPI_SUM); }
  [[nodiscard]] double least(double here) const { return reduced(here, MPI_DOUBLE, MPI_MIN); }
  [[nodiscard]] double greatest(double here) const { return reduced(here, MPI_DOUBLE, MPI_MAX); }
  [[nodiscard]] std::uint64_t sum(std::uint64_t here) const { return reduced(here, MPI_UINT64_T, MPI_SUM); }
  [[nodiscard]] std::uint64_t least(std::uint64_t here) const { return reduced(here, MPI_UINT64_T, MPI_MIN); }
  [[nodiscard]] std::uint64_t greatest(std::uint64_t here) const { return reduced(here, MPI_UINT64_T, MPI_MAX); }
  [[nodiscard]] bool any(bool here) const { return reduced(here ? 1 : 0, MPI_INT, MPI_MAX) != 0; }
  /// Adds up the ranks' values element by element, in place.
  void sum(std::span<std::uint64_t> here) const;
  void least(std::span<double> here) const;

  /// Returns one value of each rank, on all.
  template <Plain T>
  [[nodiscard]] std::vector<T> all_of(const T& here) const {
    std::vector<T> all(static_cast<std::size_t>(size_));
    MPI_Allgather(&here, sizeof(T), MPI_BYTE, all.data(), sizeof(T), MPI_BYTE, comm_);
    return all;
  }
  /// Makes ranges from the count of each rank.
  [[nodiscard]] Ranges ranges(std::uint64_t here) const { return Ranges(all_of(here)); }
  /// Returns the box around all ranks' points.
  [[nodiscard]] PointBox around_all(const PointBox& here) const;
  /// Sends one rank's values to all.
  template <Plain T>
  void broadcast(T& value, int from) const {
    MPI_Bcast(&value, sizeof(T), MPI_BYTE, from, comm_);
  }
  void broadcast(std::string& text, int from) const;
  template <Plain T>
  void broadcast(std::vector<T>& values, int from) const {
    std::uint64_t count = values.size();
    broadcast(count, from);
    values.resize(count);
    broadcast_bytes(std::as_writable_bytes(std::span(values)), from);
  }
  /// Sends to[r] to rank r; returns the values that each rank sent here.
  template <Plain T>
  [[nodiscard]] Parts<T> exchange(const Parts<T>& to) const {
    Parts<T> from;
    from.offsets = exchange_counts(to.offsets);
    from.values.resize(from.offsets.back());
    exchange_bytes(std::as_bytes(std::span(to.values)), to.offsets, std::as_writable_bytes(std::span(from.values)), from.offsets,
                   sizeof(T));
    return from;
  }
  template <Plain T>
  [[nodiscard]] Parts<T> exchange(const std::vector<std::vector<T>>& to) const {
    return exchange(joined(to));
  }
  /// Exchanges parts whose sizes both sides know.
  template <Plain T>
  void exchange(std::span<const T> to, std::span<const std::uint64_t> to_offsets, std::span<T> from,
                std::span<const std::uint64_t> from_offsets) const {
    exchange_bytes(std::as_bytes(to), to_offsets, std::as_writable_bytes(from), from_offsets, sizeof(T));
  }
  /// Returns all values of the ranks, in their order, on rank 0; nothing on others.
  template <Plain T>
  [[nodiscard]] std::vector<T> gather(const std::vector<T>& here) const {
    std::vector<std::vector<T>> to(static_cast<std::size_t>(size_));
    to[0] = here;
    return exchange(to).values;
  }

  /// Returns the different sentences of all ranks, sorted, on rank 0; nothing on others.
  [[nodiscard]] std::vector<std::string> gather_sentences(const std::vector<std::string>& here) const;

  /// Does work that may fail on some ranks alone and that does not communicate. If it fails, all ranks throw the error of the first of
  /// them: a SharedError that names it.
  void together(const std::function<void()>& work) const;

  template <Plain T>
  [[nodiscard]] static Parts<T> joined(const std::vector<std::vector<T>>& parts) {
    Parts<T> all;
    all.offsets.push_back(0);
    for (const auto& part : parts) {
      all.values.insert(all.values.end(), part.begin(), part.end());
      all.offsets.push_back(all.values.size());
    }
    return all;
  }

 private:
  template <class T>
  [[nodiscard]] T reduced(T here, MPI_Datatype type, MPI_Op how) const {
    T all{};
    MPI_Allreduce(&here, &all, 1, type, how, comm_);
    return all;
  }
  void broadcast_bytes(std::span<std::byte> bytes, int from) const;
  [[nodiscard]] std::vector<std::uint64_t> exchange_counts(std::span<const std::uint64_t> offsets) const;
  void exchange_bytes(std::span<const std::byte> to, std::span<const std::uint64_t> to_offsets, std::span<std::byte> from,
                      std::span<const std::uint64_t> from_offsets, std::size_t size) const;

  MPI_Comm comm_;
  int rank_ = 0, size_ = 1;
};

/// Sorts things by the rank that gets them, without a vector for each rank. each(give): calls give(rank, thing) for all of them, the same
/// in both of its passes. `places`: gets the place of each thing in the parts; null: not wanted.
template <Plain T, class Each>
[[nodiscard]] Parts<T> deal(const World& world, const Each& each, std::vector<std::uint64_t>* places = nullptr) {
  std::vector<std::uint64_t> next(static_cast<std::size_t>(world.size()) + 1, 0);
  each([&next](int rank, const T& /*thing*/) { ++next[static_cast<std::size_t>(rank) + 1]; });
  for (std::size_t r = 1; r < next.size(); ++r) next[r] += next[r - 1];
  Parts<T> parts{std::vector<T>(next.back()), next};
  each([&](int rank, const T& thing) {
    const std::uint64_t at = next[static_cast<std::size_t>(rank)]++;
    parts.values[at] = thing;
    if (places != nullptr) places->push_back(at);
  });
  return parts;
}

/// Sends each rank's keys to their keepers, and the keepers' answers back. The world must outlive it.
template <Plain Key>
class Keepers {
 public:
  /// Takes a key for each of this rank's things; all ranks together.
  template <class KeeperOf>
  Keepers(const World& world, std::span<const Key> keys, const KeeperOf& keeper_of) : world_(world) {
    place_.reserve(keys.size());
    const auto each = [&](const auto& give) {
      for (const Key& key : keys) give(keeper_of(key), key);
    };
    Parts<Key> to = deal<Key>(world, each, &place_);
    kept_ = world.exchange(to);
    offsets_ = std::move(to.offsets);
  }
  /// Keys that arrived, in the order of the ranks and of their things.
  [[nodiscard]] const std::vector<Key>& kept() const noexcept { return kept_.values; }
  /// Sends answers back to each rank and returns those for this rank's things, by thing. `answers`: one for each of kept().
  template <Plain Answer>
  [[nodiscard]] std::vector<Answer> give_back(const std::vector<Answer>& answers) const {
    std::vector<Answer> back(place_.size()), in_order;
    world_.exchange<Answer>(answers, kept_.offsets, back, offsets_);
    in_order.reserve(place_.size());
    for (const std::uint64_t at : place_) in_order.push_back(back[at]);
    return in_order;
  }
  /// Sends other values of the things to the keys' keepers. `values`: one a thing. Returns those that arrived, in the order of kept().
  template <Plain Value>
  [[nodiscard]] std::vector<Value> take_along(const std::vector<Value>& values) const {
    std::vector<Value> to(place_.size()), there(kept_.values.size());
    for (std::size_t i = 0; i < values.size(); ++i) to[place_[i]] = values[i];
    world_.exchange<Value>(to, offsets_, there, kept_.offsets);
    return there;
  }

 private:
  const World& world_;
  std::vector<std::uint64_t> place_, offsets_;
  Parts<Key> kept_;
};

/// Asks the holders of numbered things about them: answer(i) of the holder, for each i of `asked`, in its order. `asked`: numbers below
/// ranges.size().
template <Plain T, class Answer>
[[nodiscard]] std::vector<T> ask_holders(const World& world, const Ranges& ranges, std::span<const std::uint64_t> asked, Answer answer) {
  const Keepers<std::uint64_t> holders(world, asked, [&](std::uint64_t i) { return ranges.holder(i); });
  std::vector<T> answers;
  answers.reserve(holders.kept().size());
  for (const std::uint64_t i : holders.kept()) answers.push_back(answer(i));
  return holders.give_back(answers);
}

}  // namespace dmoscope
