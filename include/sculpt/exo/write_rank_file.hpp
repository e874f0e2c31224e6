#pragma once
// Writes one rank's mesh as an Exodus II file with Nemesis tables, in the way of SEACAS: everything is
// defined first, in a few calls, so that thousands of blocks and sets cost next to nothing.
//
// A file appears under its final name only when all ranks are done:
//     write_rank_file(temporary_name(final), mesh);   every rank on its own
//     ... all ranks agree that this went well ...
//     publish(temporary_name(final), final);          or discard(temporary_name(final))
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "sculpt/exo/rank_mesh.hpp"

namespace sculpt {

// The part of `path` that one of several ranks has: path.<ranks>.<rank>, the rank zero padded to the digits
// of `ranks`.
[[nodiscard]] std::string part_file_name(const std::string& path, int ranks, int rank);

// base.e.<ranks>.<rank>, as part_file_name() says. The extension may be another one.
[[nodiscard]] std::string rank_file_name(const std::string& base, int ranks, int rank,
                                         const std::string& extension = "e");

// A hidden name in the same folder as `final_name`, so that publish() is one rename.
[[nodiscard]] std::string temporary_name(const std::string& final_name);

// The name that a temporary one stands for, which is what messages show; other names stay as they are.
[[nodiscard]] std::string shown_name(const std::string& path);

// Local. Throws Error with the file and the cause (disk full, no permission, a limit of the format); the file
// is removed then. Throws BrokenPromise when the mesh contradicts itself.
void write_rank_file(const std::string& path, const RankMesh& mesh);

// The values of one element variable at one step, both from 0; valid until the next call. Steps ascend, and
// in each step the variables.
using ElementValues = std::function<std::span<const double>(std::size_t step, std::size_t variable)>;

// The same, but the values come from `values` and not from the mesh: they need not be in memory all at once.
void write_rank_file(const std::string& path, const RankMesh& mesh, const ElementValues& values);

// Local. Puts a finished file in place, over an earlier one. Throws Error, leaving the earlier file as it
// was.
void publish(const std::string& temporary, const std::string& final_name);

// Local. Removes a file that is not wanted any more; it may be absent. Never throws.
void discard(const std::string& temporary) noexcept;

}  // namespace sculpt
