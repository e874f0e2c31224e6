#include "sculpt/par/ghost_exchange.hpp"

#include <climits>

namespace sculpt {

GhostExchange::GhostExchange(const Comm& comm, std::span<const GlobalId> ids,
                             std::span<const std::int32_t> owner, std::span<const GlobalId> homes)
    : comm_(comm) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  std::vector<std::vector<GlobalId>> wanted(ranks);
  std::vector<std::vector<LocalId>> ghosts(ranks);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (owner[i] == comm.rank()) continue;
    const auto r = static_cast<std::size_t>(owner[i] % comm.size());
    wanted[r].push_back(homes.empty() ? ids[i] : homes[i]);
    ghosts[r].push_back(static_cast<LocalId>(i));
  }
  const auto asked = comm.all_to_all(wanted);
  bool known = true;
  for (std::size_t r = 0; r < ranks; ++r) {
    if (!ghosts[r].empty()) receive_.push_back({static_cast<int>(r), std::move(ghosts[r])});
    if (asked[r].empty()) continue;
    Link link{static_cast<int>(r), {}};
    link.items.reserve(asked[r].size());
    for (const GlobalId id : asked[r]) {
      const auto at = std::lower_bound(ids.begin(), ids.end(), id);
      if (at == ids.end() || *at != id) {
        known = false;
        break;
      }
      link.items.push_back(static_cast<LocalId>(at - ids.begin()));
    }
    send_.push_back(std::move(link));
  }
  collectively(comm, "building the ghost exchange", [&] { check(known, "a ghost is unknown to its owner"); });
}

GhostExchange::Messages GhostExchange::swap(const std::vector<Link>& to, const Messages& out,
                                            const std::vector<Link>& from) const {
  constexpr int kTag = 72;
  std::vector<MPI_Request> requests;
  std::size_t own = to.size();  // the link with this rank itself
  for (std::size_t l = 0; l < to.size(); ++l) {
    if (to[l].rank == comm_.rank()) {
      own = l;
      continue;
    }
    check(out[l].size() <= static_cast<std::size_t>(INT_MAX), "ghost exchange: a message of more than 2 GB");
    MPI_Isend(out[l].data(), static_cast<int>(out[l].size()), MPI_CHAR, to[l].rank, kTag, comm_.handle(),
              &requests.emplace_back());
  }
  Messages in(from.size());
  for (std::size_t l = 0; l < from.size(); ++l) {
    if (from[l].rank == comm_.rank()) {
      in[l] = out[own];
      continue;
    }
    MPI_Status status;
    int size = 0;
    MPI_Probe(from[l].rank, kTag, comm_.handle(), &status);
    MPI_Get_count(&status, MPI_CHAR, &size);
    in[l].resize(static_cast<std::size_t>(size));
    MPI_Recv(in[l].data(), size, MPI_CHAR, from[l].rank, kTag, comm_.handle(), MPI_STATUS_IGNORE);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return in;
}

}  // namespace sculpt
