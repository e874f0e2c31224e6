#pragma once
// Reads Exodus files: serial ones, and the rank files of a parallel run. All that is read is checked, so that
// a file that was cut off, damaged or made by a careless program ends in an Error and not in a wrong mesh.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sculpt/exo/rank_mesh.hpp"

namespace sculpt {

class ExodusFile;

// Items [first, first + count) of a list of a file; by default all of them.
struct ExodusRange {
  static constexpr std::int64_t kToTheEnd = -1;
  std::int64_t first = 0, count = kToTheEnd;
};

// A file open for reading, piece by piece. Local. Every member function throws Error that names the file.
class ExodusReader {
 public:
  struct Block {
    std::int64_t id = 0;
    std::string name;  // empty = none
    std::string type;  // as in the file; "NULL" when a rank has none of a block
    int nodes_per_element = 0;
    std::int64_t count = 0;         // elements in this file
    std::int64_t global_count = 0;  // elements on all ranks; equal to `count` in a serial file
  };
  struct Set {
    std::int64_t id = 0;
    std::string name;
    std::int64_t count = 0, global_count = 0;
  };
  struct Header {
    std::string title;
    std::int64_t nodes = 0, elements = 0;
    std::vector<Block> blocks;
    std::vector<Set> side_sets, node_sets;
    std::vector<double> times;  // of the steps
    std::vector<RankMesh::ElementVariable> element_variables;
    int other_variables = 0;  // global ones, and those of nodes and sets
    bool nemesis = false;     // the file belongs to a parallel run; the next four come from its tables then
    int ranks = 1;
    char kind = 'p';  // of file: 'p' = the mesh of one rank, 's' = data about all ranks
    std::int64_t global_nodes = 0, global_elements = 0;
    bool large = false;  // 64-bit integers on disk
  };

  explicit ExodusReader(const std::string& path);
  ~ExodusReader();
  ExodusReader(const ExodusReader&) = delete;
  ExodusReader& operator=(const ExodusReader&) = delete;

  [[nodiscard]] const Header& header() const { return header_; }
  [[nodiscard]] const std::string& path() const { return path_; }

  void coordinates(std::vector<double>& x, std::vector<double>& y, std::vector<double>& z,
                   ExodusRange nodes = {});
  [[nodiscard]] std::vector<std::int64_t> node_ids(ExodusRange nodes = {});  // 1..N when the file has none
  [[nodiscard]] std::vector<std::int64_t> element_ids(ExodusRange elements = {});  // likewise
  // Local nodes, from 1, nodes_per_element for each of these elements of blocks[b].
  [[nodiscard]] std::vector<std::int32_t> connectivity(std::size_t b, ExodusRange elements = {});
  // Local elements, from 1, and their sides, 1..6, of these entries of side_sets[s].
  void side_set(std::size_t s, std::vector<std::int32_t>& element, std::vector<std::int32_t>& side,
                ExodusRange entries = {});
  [[nodiscard]] std::vector<std::int32_t> node_set(std::size_t s, ExodusRange entries = {});
  // A value for each of these elements of blocks[b] at a step, from 0 as the variable; 0 where the block has
  // none.
  [[nodiscard]] std::vector<double> block_values(std::size_t step, std::size_t variable, std::size_t b,
                                                 ExodusRange elements = {});
  // The same for all elements of the file.
  [[nodiscard]] std::vector<double> element_values(std::size_t step, std::size_t variable);
  // The counts and maps of Nemesis; leaves `mesh` as it is when the file has none.
  void nemesis(RankMesh& mesh);

 private:
  void read_header();
  void read_blocks();
  void read_sets();
  void read_variables();
  void read_global();

  std::string path_;
  std::unique_ptr<ExodusFile> file_;
  Header header_;
};

// Whether its elements are HEX or HEX8, in any case, with 8 nodes.
[[nodiscard]] bool is_hex(const ExodusReader::Block& block);

// A whole file, of any element types. What a rank file does not say is `rank`: it stays 0.
[[nodiscard]] RankMesh read_exodus(const std::string& path);

}  // namespace sculpt
