#pragma once
// Copies of shared entities kept equal: every entity has one owner rank, other ranks hold ghosts of it.
// Messages are ordered by global id, so that they carry values only.
//
// In a periodic mesh an entity may also have images: copies of it a whole number of periods away, with ids
// of their own. To all exchanges an image is one more ghost, whichever rank holds it, also that of the owner
// itself; its home is the id of the entity it is an image of.
#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sculpt/base/types.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

class GhostExchange {
 public:
  // One rank and the local entities exchanged with it, in the same order on both sides: ascending in the
  // global ids of the ghosts. What is sent may occur several times, once for every image, and the rank may
  // be this one.
  struct Link {
    int rank;
    std::vector<LocalId> items;
  };

  GhostExchange() : comm_(Comm::self()) {}
  // Collective. ids: global ids of the local entities, ascending; owner: their owner ranks, plus comm.size()
  // for images; homes: the ids that the owners know the entities by, empty where these are `ids`. Throws
  // BrokenPromise when a ghost is unknown to its owner.
  GhostExchange(const Comm& comm, std::span<const GlobalId> ids, std::span<const std::int32_t> owner,
                std::span<const GlobalId> homes = {});

  // Collective. Every ghost takes its owner's value.
  template <class T>
  void copy_to_ghosts(std::span<T> values) const {
    static_assert(std::is_trivially_copyable_v<T>);
    Messages out(send_.size());
    for (std::size_t l = 0; l < send_.size(); ++l) pack<T>(send_[l], values, out[l]);
    const Messages in = swap(send_, out, receive_);
    for (std::size_t l = 0; l < receive_.size(); ++l)
      for (std::size_t i = 0; i < receive_[l].items.size(); ++i)
        std::memcpy(&values[index(receive_[l].items[i])], in[l].data() + i * sizeof(T), sizeof(T));
  }
  template <class T>
  void copy_to_ghosts(std::vector<T>& values) const {
    copy_to_ghosts(std::span<T>(values));
  }

  // Collective. As copy_to_ghosts, for the owned entities whose flag is set only; clears the flags of what it
  // sent and calls arrived(ghost) for every ghost that took a new value.
  template <class T, class Arrived>
  void copy_changed(std::span<T> values, std::span<std::uint8_t> changed, Arrived&& arrived) const {
    static_assert(std::is_trivially_copyable_v<T>);
    Messages out(send_.size());
    for (std::size_t l = 0; l < send_.size(); ++l)
      for (std::size_t i = 0; i < send_[l].items.size(); ++i)
        if (changed[index(send_[l].items[i])] != 0) {
          append(out[l], static_cast<std::int32_t>(i));
          append(out[l], values[index(send_[l].items[i])]);
        }
    for (const Link& link : send_)
      for (const LocalId item : link.items) changed[index(item)] = 0;
    const Messages in = swap(send_, out, receive_);
    for (std::size_t l = 0; l < receive_.size(); ++l)
      for (const char* at = in[l].data(); at != in[l].data() + in[l].size();) {
        std::int32_t slot;
        take(at, slot);
        const LocalId ghost = receive_[l].items[static_cast<std::size_t>(slot)];
        take(at, values[index(ghost)]);
        arrived(ghost);
      }
  }

  // Collective. Each owner takes combine(own value, ghost value) over all ghosts of it; combine must not
  // depend on the order of its calls (minimum, maximum, bitwise or).
  template <class T, class Combine>
  void reduce_to_owners(std::span<T> values, Combine&& combine) const {
    static_assert(std::is_trivially_copyable_v<T>);
    Messages out(receive_.size());
    for (std::size_t l = 0; l < receive_.size(); ++l) pack<T>(receive_[l], values, out[l]);
    const Messages in = swap(receive_, out, send_);
    for (std::size_t l = 0; l < send_.size(); ++l) {
      const char* at = in[l].data();
      for (const LocalId item : send_[l].items) {
        T theirs;
        take(at, theirs);
        values[index(item)] = combine(values[index(item)], theirs);
      }
    }
  }

  // Collective. write(owned entity, bytes) appends what the ghosts of an entity shall learn (nothing is
  // fine); read(ghost, bytes, end) returns where it stopped. For records of unequal length.
  template <class Write, class Read>
  void send_records(Write&& write, Read&& read) const {
    Messages out(send_.size());
    for (std::size_t l = 0; l < send_.size(); ++l)
      for (std::size_t i = 0; i < send_[l].items.size(); ++i) {
        const std::size_t before = out[l].size();
        append(out[l], static_cast<std::int32_t>(i));
        write(send_[l].items[i], out[l]);
        if (out[l].size() == before + sizeof(std::int32_t)) out[l].resize(before);
      }
    const Messages in = swap(send_, out, receive_);
    for (std::size_t l = 0; l < receive_.size(); ++l)
      for (const char* at = in[l].data(); at != in[l].data() + in[l].size();) {
        std::int32_t slot;
        take(at, slot);
        at = read(receive_[l].items[static_cast<std::size_t>(slot)], at);
      }
  }

  [[nodiscard]] const std::vector<Link>& sends() const { return send_; }
  [[nodiscard]] const std::vector<Link>& receives() const { return receive_; }
  [[nodiscard]] const Comm& comm() const { return comm_; }

  template <class T>
  static void append(std::vector<char>& bytes, const T& value) {
    const auto* at = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), at, at + sizeof(T));
  }
  template <class T>
  static void take(const char*& at, T& value) {
    std::memcpy(&value, at, sizeof(T));
    at += sizeof(T);
  }

 private:
  using Messages = std::vector<std::vector<char>>;
  static std::size_t index(LocalId id) { return static_cast<std::size_t>(id); }
  // The values of all items of a link, one after another.
  template <class T>
  static void pack(const Link& link, std::span<const T> values, std::vector<char>& bytes) {
    bytes.resize(link.items.size() * sizeof(T));
    char* to = bytes.data();
    for (const LocalId item : link.items) {
      std::memcpy(to, &values[index(item)], sizeof(T));
      to += sizeof(T);
    }
  }
  // One message to every rank of `to`, one from every rank of `from`.
  [[nodiscard]] Messages swap(const std::vector<Link>& to, const Messages& out,
                              const std::vector<Link>& from) const;

  Comm comm_;
  std::vector<Link> send_, receive_;
};

}  // namespace sculpt
