#include "mpi/world/world.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace dmoscope {
namespace {

/// Greatest size of a message, in bytes, for MPI counts in ints: longer messages are sent in pieces.
constexpr std::size_t kMostBytes = std::size_t{1} << 30U;

}  // namespace

MpiSession::MpiSession(int& argc, char**& argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
}

MpiSession::~MpiSession() { MPI_Finalize(); }

void MpiSession::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::abort();
}

Ranges::Ranges(std::span<const std::uint64_t> counts) {
  for (const std::uint64_t count : counts) begin_.push_back(begin_.back() + count);
}

Ranges::Ranges(std::uint64_t size, int ranks, std::uint64_t grain) {
  const std::uint64_t grains = (size + grain - 1) / grain, all = static_cast<std::uint64_t>(ranks);
  for (std::uint64_t r = 1; r <= all; ++r) {
    // grains * r / all, in parts, for the product could overflow.
    const std::uint64_t share = grains / all * r + grains % all * r / all;
    begin_.push_back(std::min(size, grain * share));
  }
}

int Ranges::holder(std::uint64_t i) const noexcept {
  return static_cast<int>(std::upper_bound(begin_.begin(), begin_.end(), i) - begin_.begin()) - 1;
}

World::World(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &size_);
}

void World::sum(std::span<std::uint64_t> here) const {
  MPI_Allreduce(MPI_IN_PLACE, here.data(), static_cast<int>(here.size()), MPI_UINT64_T, MPI_SUM, comm_);
}

void World::least(std::span<double> here) const {
  MPI_Allreduce(MPI_IN_PLACE, here.data(), static_cast<int>(here.size()), MPI_DOUBLE, MPI_MIN, comm_);
}

PointBox World::around_all(const PointBox& here) const {
  std::array<double, 6> ends{here.low.x, here.low.y, here.low.z, -here.high.x, -here.high.y, -here.high.z};
  least(ends);
  return {{ends[0], ends[1], ends[2]}, {-ends[3], -ends[4], -ends[5]}};
}

void World::broadcast(std::string& text, int from) const {
  std::uint64_t count = text.size();
  broadcast(count, from);
  text.resize(count);
  broadcast_bytes(std::as_writable_bytes(std::span(text)), from);
}

void World::broadcast_bytes(std::span<std::byte> bytes, int from) const {
  for (std::size_t at = 0; at < bytes.size(); at += kMostBytes)
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(kMostBytes, bytes.size() - at)), MPI_BYTE, from, comm_);
}

std::vector<std::uint64_t> World::exchange_counts(std::span<const std::uint64_t> offsets) const {
  std::vector<std::uint64_t> to(static_cast<std::size_t>(size_)), from(to.size());
  for (std::size_t r = 0; r < to.size(); ++r) to[r] = offsets[r + 1] - offsets[r];
  MPI_Alltoall(to.data(), 1, MPI_UINT64_T, from.data(), 1, MPI_UINT64_T, comm_);
  std::vector<std::uint64_t> begin(from.size() + 1, 0);
  std::partial_sum(from.begin(), from.end(), begin.begin() + 1);
  return begin;
}

void World::exchange_bytes(std::span<const std::byte> to, std::span<const std::uint64_t> to_offsets, std::span<std::byte> from,
                           std::span<const std::uint64_t> from_offsets, std::size_t size) const {
  constexpr int kTag = 11;
  std::vector<MPI_Request> requests;
  const auto in_pieces = [&](std::uint64_t begin, std::uint64_t end, const auto& post) {
    for (std::uint64_t at = begin * size; at < end * size; at += kMostBytes) {
      requests.emplace_back();
      post(at, static_cast<int>(std::min<std::uint64_t>(kMostBytes, end * size - at)), &requests.back());
    }
  };
  for (int r = 0; r < size_; ++r) {
    const auto i = static_cast<std::size_t>(r);
    if (r == rank_) continue;
    in_pieces(from_offsets[i], from_offsets[i + 1], [&](std::uint64_t at, int count, MPI_Request* request) {
      MPI_Irecv(from.data() + at, count, MPI_BYTE, r, kTag, comm_, request);
    });
  }
  for (int step = 1; step < size_; ++step) {  // every rank begins with another one
    const int r = (rank_ + step) % size_;
    const auto i = static_cast<std::size_t>(r);
    in_pieces(to_offsets[i], to_offsets[i + 1], [&](std::uint64_t at, int count, MPI_Request* request) {
      MPI_Isend(to.data() + at, count, MPI_BYTE, r, kTag, comm_, request);
    });
  }
  const auto own = static_cast<std::size_t>(rank_);
  const std::size_t bytes = (to_offsets[own + 1] - to_offsets[own]) * size;
  if (bytes > 0) std::memcpy(from.data() + from_offsets[own] * size, to.data() + to_offsets[own] * size, bytes);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

std::vector<std::string> World::gather_sentences(const std::vector<std::string>& here) const {
  std::vector<char> text;
  for (const std::string& sentence : here) {
    text.insert(text.end(), sentence.begin(), sentence.end());
    text.push_back('\n');
  }
  std::vector<std::string> all;
  std::string one;
  for (const char c : gather(text)) {
    if (c != '\n') {
      one += c;
      continue;
    }
    all.push_back(std::exchange(one, {}));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void World::together(const std::function<void()>& work) const {
  std::string message;
  int code = 0;
  const auto failed = [&](const std::string& what, int exit_code) {
    message = size_ == 1 ? what : fmt::format("rank {}: {}", rank_, what);
    code = exit_code;
  };
  try {
    work();
  } catch (const SharedError&) {
    throw;  // all ranks have it already
  } catch (const Error& error) {
    failed(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    failed("not enough memory for this mesh", 3);
  } catch (const std::exception& error) {
    failed(error.what(), 3);
  }
  const int none = size_, first = reduced(code != 0 ? rank_ : none, MPI_INT, MPI_MIN);
  if (first == none) return;
  broadcast(message, first);
  broadcast(code, first);
  throw SharedError(message, code);
}

}  // namespace dmoscope
