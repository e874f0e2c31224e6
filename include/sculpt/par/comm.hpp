#pragma once
// A group of ranks and what they can agree on. The only reductions offered are those whose result does not
// depend on the number or order of ranks: sums of integers, minima and maxima (docs/architecture.md, same
// bits).
#include <mpi.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sculpt/base/error.hpp"

namespace sculpt {

// Starts and ends MPI; one per program, before the first Comm.
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

// An error that every rank of the communicator throws together, with the same text.
class AgreedError : public Error {
 public:
  using Error::Error;
};

// All member functions but rank() and size() are collective.
class Comm {
 public:
  static Comm world();
  static Comm self();

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] MPI_Comm handle() const { return comm_; }

  [[nodiscard]] std::int64_t sum(std::int64_t value) const;
  [[nodiscard]] std::int64_t min(std::int64_t value) const;
  [[nodiscard]] std::int64_t max(std::int64_t value) const;
  [[nodiscard]] double min(double value) const;
  [[nodiscard]] double max(double value) const;
  // Elementwise over vectors of equal length on all ranks.
  void sum(std::span<std::int64_t> values) const;
  // Bitwise or, elementwise over vectors of equal length on all ranks.
  void bit_or(std::span<std::uint64_t> values) const;
  // Sum over the ranks before this one.
  [[nodiscard]] std::int64_t exclusive_sum(std::int64_t value) const;
  void exclusive_sum(std::span<std::int64_t> values) const;

  [[nodiscard]] std::string broadcast(std::string text, int root) const;
  void barrier() const;

  // The ranks' items one after another, in rank order, on every rank.
  template <class T>
  [[nodiscard]] std::vector<T> concatenate(std::span<const T> items) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<char> bytes =
        concatenate_bytes({reinterpret_cast<const char*>(items.data()), items.size_bytes()});
    std::vector<T> all(bytes.size() / sizeof(T));
    copy_bytes(bytes.data(), all.data(), bytes.size());
    return all;
  }
  template <class T>
  [[nodiscard]] std::vector<T> concatenate(const std::vector<T>& items) const {
    return concatenate(std::span<const T>(items));
  }
  // One item of every rank.
  template <class T>
  [[nodiscard]] std::vector<T> gather_all(const T& item) const {
    return concatenate(std::span<const T>(&item, 1));
  }
  template <class T>
  void broadcast(std::vector<T>& items, int root) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::string bytes(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
    bytes = broadcast(std::move(bytes), root);
    items.resize(bytes.size() / sizeof(T));
    copy_bytes(bytes.data(), items.data(), bytes.size());
  }
  // to[r] goes to rank r; the answer's [r] came from rank r. Empty vectors cost next to nothing.
  template <class T>
  [[nodiscard]] std::vector<std::vector<T>> all_to_all(const std::vector<std::vector<T>>& to) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::span<const char>> out(to.size());
    for (std::size_t r = 0; r < to.size(); ++r)
      out[r] = {reinterpret_cast<const char*>(to[r].data()), to[r].size() * sizeof(T)};
    std::vector<std::vector<T>> in(to.size());
    all_to_all_bytes(out, [&in](int from, std::size_t bytes) {
      in[static_cast<std::size_t>(from)].resize(bytes / sizeof(T));
      return reinterpret_cast<char*>(in[static_cast<std::size_t>(from)].data());
    });
    return in;
  }

 private:
  explicit Comm(MPI_Comm comm);
  [[nodiscard]] std::vector<char> concatenate_bytes(std::span<const char> bytes) const;
  void all_to_all_bytes(const std::vector<std::span<const char>>& out,
                        const std::function<char*(int, std::size_t)>& place) const;
  static void copy_bytes(const void* from, void* to, std::size_t bytes);

  MPI_Comm comm_;
  int rank_ = 0, size_ = 1;
};

// The text of the exception being handled; never empty.
[[nodiscard]] std::string current_exception_text();

// Collective. Runs work on this rank (no communication inside); when it fails on any rank, all ranks throw
// the lowest failing rank's text as AgreedError. `doing` is for failures that are not the user's.
void collectively(const Comm& comm, std::string_view doing, const std::function<void()>& work);

}  // namespace sculpt
