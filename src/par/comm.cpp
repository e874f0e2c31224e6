#include "sculpt/par/comm.hpp"

#include <algorithm>
#include <climits>
#include <cstring>
#include <new>

namespace sculpt {
namespace {

// Messages larger than an int counts in bytes travel in pieces of this size.
constexpr std::size_t kPiece = std::size_t{1} << 30;

template <class T>
T reduced(MPI_Comm comm, T value, MPI_Datatype type, MPI_Op op) {
  T result{};
  MPI_Allreduce(&value, &result, 1, type, op, comm);
  return result;
}

}  // namespace

MpiSession::MpiSession(int& argc, char**& argv) { MPI_Init(&argc, &argv); }
MpiSession::~MpiSession() { MPI_Finalize(); }

Comm::Comm(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}
Comm Comm::world() { return Comm(MPI_COMM_WORLD); }
Comm Comm::self() { return Comm(MPI_COMM_SELF); }

std::int64_t Comm::sum(std::int64_t value) const { return reduced(comm_, value, MPI_INT64_T, MPI_SUM); }
std::int64_t Comm::min(std::int64_t value) const { return reduced(comm_, value, MPI_INT64_T, MPI_MIN); }
std::int64_t Comm::max(std::int64_t value) const { return reduced(comm_, value, MPI_INT64_T, MPI_MAX); }
double Comm::min(double value) const { return reduced(comm_, value, MPI_DOUBLE, MPI_MIN); }
double Comm::max(double value) const { return reduced(comm_, value, MPI_DOUBLE, MPI_MAX); }

void Comm::sum(std::span<std::int64_t> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM, comm_);
}

void Comm::bit_or(std::span<std::uint64_t> values) const {
  constexpr std::size_t kPiece = std::size_t{1} << 24;  // counts of MPI are 32 bits wide
  for (std::size_t at = 0; at < values.size(); at += kPiece)
    MPI_Allreduce(MPI_IN_PLACE, values.data() + at, static_cast<int>(std::min(kPiece, values.size() - at)),
                  MPI_UINT64_T, MPI_BOR, comm_);
}

std::int64_t Comm::exclusive_sum(std::int64_t value) const {
  exclusive_sum(std::span<std::int64_t>(&value, 1));
  return value;
}

void Comm::exclusive_sum(std::span<std::int64_t> values) const {
  std::vector<std::int64_t> before(values.size(), 0);
  MPI_Exscan(values.data(), before.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM, comm_);
  if (rank_ == 0) before.assign(values.size(), 0);  // MPI leaves rank 0's result undefined
  std::memcpy(values.data(), before.data(), values.size_bytes());
}

std::string Comm::broadcast(std::string text, int root) const {
  std::uint64_t size = text.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm_);
  text.resize(size);
  for (std::size_t at = 0; at < size; at += kPiece)
    MPI_Bcast(text.data() + at, static_cast<int>(std::min<std::size_t>(kPiece, size - at)), MPI_CHAR, root,
              comm_);
  return text;
}

void Comm::barrier() const { MPI_Barrier(comm_); }

std::vector<char> Comm::concatenate_bytes(std::span<const char> bytes) const {
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<int> counts(ranks), starts(ranks, 0);
  check(bytes.size() < static_cast<std::size_t>(INT_MAX), "concatenate: more than 2 GB from one rank");
  const int mine = static_cast<int>(bytes.size());
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  std::size_t total = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    starts[r] = static_cast<int>(total);
    total += static_cast<std::size_t>(counts[r]);
  }
  check(total < static_cast<std::size_t>(INT_MAX), "concatenate: more than 2 GB in all");
  std::vector<char> all(total);
  MPI_Allgatherv(bytes.data(), mine, MPI_CHAR, all.data(), counts.data(), starts.data(), MPI_CHAR, comm_);
  return all;
}

void Comm::all_to_all_bytes(const std::vector<std::span<const char>>& out,
                            const std::function<char*(int, std::size_t)>& place) const {
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<std::uint64_t> sends(ranks), arrivals(ranks);
  for (std::size_t r = 0; r < ranks; ++r) sends[r] = out[r].size();
  MPI_Alltoall(sends.data(), 1, MPI_UINT64_T, arrivals.data(), 1, MPI_UINT64_T, comm_);
  std::vector<MPI_Request> requests;
  constexpr int kTag = 71;
  for (std::size_t r = 0; r < ranks; ++r) {
    char* const at = place(static_cast<int>(r), arrivals[r]);
    if (static_cast<int>(r) == rank_) {
      if (!out[r].empty()) std::memcpy(at, out[r].data(), out[r].size());
      continue;
    }
    for (std::size_t done = 0; done < arrivals[r]; done += kPiece)
      MPI_Irecv(at + done, static_cast<int>(std::min<std::size_t>(kPiece, arrivals[r] - done)), MPI_CHAR,
                static_cast<int>(r), kTag, comm_, &requests.emplace_back());
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    if (static_cast<int>(r) == rank_) continue;
    for (std::size_t done = 0; done < out[r].size(); done += kPiece)
      MPI_Isend(out[r].data() + done, static_cast<int>(std::min<std::size_t>(kPiece, out[r].size() - done)),
                MPI_CHAR, static_cast<int>(r), kTag, comm_, &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void Comm::copy_bytes(const void* from, void* to, std::size_t bytes) {
  if (bytes > 0) std::memcpy(to, from, bytes);
}

std::string current_exception_text() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& e) {
    const std::string text = e.what();
    return text.empty() ? "unknown failure" : text;
  } catch (...) {
    return "unknown failure";
  }
}

void collectively(const Comm& comm, std::string_view doing, const std::function<void()>& work) {
  std::string failure;
  try {
    work();
  } catch (const Error& e) {
    failure = e.what();
  } catch (...) {
    failure = std::string(doing) + ": " + current_exception_text();
  }
  const int first = static_cast<int>(comm.min(std::int64_t{failure.empty() ? comm.size() : comm.rank()}));
  if (first == comm.size()) return;
  throw AgreedError(comm.broadcast(failure, first));
}

}  // namespace sculpt
