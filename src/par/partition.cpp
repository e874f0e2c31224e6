#include "sculpt/par/partition.hpp"

#include <fmt/core.h>
#include <zoltan.h>

#include <cstring>
#include <limits>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

// Zoltan's ids have 32 bits: two of them are one of ours.
static_assert(2 * sizeof(ZOLTAN_ID_TYPE) == sizeof(GlobalId));
constexpr const char* kIdEntries = "2";

void put_id(ZOLTAN_ID_PTR to, std::size_t i, GlobalId id) { std::memcpy(to + 2 * i, &id, sizeof id); }

// What Zoltan asks for; data is the PartitionObjects.
const PartitionObjects& objects_of(void* data) { return *static_cast<const PartitionObjects*>(data); }

int count_objects(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(objects_of(data).id.size());
}

void list_objects(void* data, int, int, ZOLTAN_ID_PTR ids, ZOLTAN_ID_PTR local, int, float*, int* error) {
  const PartitionObjects& objects = objects_of(data);
  for (std::size_t i = 0; i < objects.id.size(); ++i) {
    put_id(ids, i, objects.id[i]);
    local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
  }
  *error = ZOLTAN_OK;
}

int count_axes(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

void list_points(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* to,
                 int* error) {
  for (int i = 0; i < count; ++i)
    for (std::size_t d = 0; d < 3; ++d) *to++ = objects_of(data).point[local[i]][d];
  *error = ZOLTAN_OK;
}

void count_neighbours(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int* to,
                      int* error) {
  const auto& first = objects_of(data).first;
  for (int i = 0; i < count; ++i) to[i] = static_cast<int>(first[local[i] + 1] - first[local[i]]);
  *error = ZOLTAN_OK;
}

void list_neighbours(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int*,
                     ZOLTAN_ID_PTR ids, int* ranks, int, float*, int* error) {
  const PartitionObjects& objects = objects_of(data);
  std::size_t at = 0;
  for (int i = 0; i < count; ++i)
    for (std::int64_t n = objects.first[local[i]]; n < objects.first[local[i] + 1]; ++n, ++at) {
      put_id(ids, at, objects.neighbour[static_cast<std::size_t>(n)]);
      ranks[at] = objects.neighbour_rank[static_cast<std::size_t>(n)];
    }
  *error = ZOLTAN_OK;
}

const char* name_of(PartitionMethod method) {
  switch (method) {
    case PartitionMethod::kRcb:
      return "RCB";
    case PartitionMethod::kRib:
      return "RIB";
    case PartitionMethod::kHsfc:
      return "HSFC";
    case PartitionMethod::kGraph:
      return "GRAPH";
  }
  return "";
}

// The ranks that have objects. Zoltan takes a rank without any for one that is out of memory (-2).
class Holders {
 public:
  // Collective.
  Holders(const Comm& comm, bool has_objects) {
    MPI_Comm_split(comm.handle(), has_objects ? 0 : MPI_UNDEFINED, comm.rank(), &comm_);
    std::int32_t next = 0;
    for (const std::int32_t has : comm.gather_all(std::int32_t{has_objects}))
      number_.push_back(has != 0 ? next++ : -1);
  }
  ~Holders() {
    if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
  }
  Holders(const Holders&) = delete;
  Holders& operator=(const Holders&) = delete;

  [[nodiscard]] MPI_Comm handle() const { return comm_; }
  [[nodiscard]] std::int32_t number(std::int32_t rank) const {
    return number_[static_cast<std::size_t>(rank)];
  }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<std::int32_t> number_;
};

class Zoltan {
 public:
  Zoltan(MPI_Comm comm, int parts, PartitionMethod method, const PartitionObjects& objects) {
    float version = 0;
    if (Zoltan_Initialize(0, nullptr, &version) != ZOLTAN_OK) return;
    zoltan_ = Zoltan_Create(comm);
    if (zoltan_ == nullptr) return;
    void* data = const_cast<PartitionObjects*>(&objects);
    good_ = set("DEBUG_LEVEL", "0") && set("LB_METHOD", name_of(method)) && set("LB_APPROACH", "PARTITION") &&
            set("NUM_GID_ENTRIES", kIdEntries) && set("NUM_LID_ENTRIES", "1") &&
            set("RETURN_LISTS", "PARTS") && set("OBJ_WEIGHT_DIM", "0") && set("EDGE_WEIGHT_DIM", "0") &&
            set("IMBALANCE_TOL", "1.05") && set("NUM_GLOBAL_PARTS", std::to_string(parts).c_str());
    good_ = good_ && Zoltan_Set_Num_Obj_Fn(zoltan_, count_objects, data) == ZOLTAN_OK &&
            Zoltan_Set_Obj_List_Fn(zoltan_, list_objects, data) == ZOLTAN_OK &&
            Zoltan_Set_Num_Geom_Fn(zoltan_, count_axes, data) == ZOLTAN_OK &&
            Zoltan_Set_Geom_Multi_Fn(zoltan_, list_points, data) == ZOLTAN_OK;
    if (method != PartitionMethod::kGraph) return;
    // PT-Scotch 7.0 is faster, but crashes or waits for ever on graphs of a few vertices per part.
    good_ = good_ && set("GRAPH_PACKAGE", "PHG") &&
            Zoltan_Set_Num_Edges_Multi_Fn(zoltan_, count_neighbours, data) == ZOLTAN_OK &&
            Zoltan_Set_Edge_List_Multi_Fn(zoltan_, list_neighbours, data) == ZOLTAN_OK;
  }
  ~Zoltan() {
    if (zoltan_ != nullptr) Zoltan_Destroy(&zoltan_);
  }
  Zoltan(const Zoltan&) = delete;
  Zoltan& operator=(const Zoltan&) = delete;

  [[nodiscard]] bool good() const { return good_; }

  // Collective over the ranks with objects. False when Zoltan fails here.
  [[nodiscard]] bool run(std::vector<std::int32_t>& part) {
    int changes = 0, id_entries = 0, local_entries = 0, imports = 0, exports = 0;
    ZOLTAN_ID_PTR import_ids = nullptr, import_local = nullptr, export_ids = nullptr, export_local = nullptr;
    int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
    const int result = Zoltan_LB_Partition(zoltan_, &changes, &id_entries, &local_entries, &imports,
                                           &import_ids, &import_local, &import_ranks, &import_parts, &exports,
                                           &export_ids, &export_local, &export_ranks, &export_parts);
    const bool good =
        (result == ZOLTAN_OK || result == ZOLTAN_WARN) && static_cast<std::size_t>(exports) == part.size();
    for (int i = 0; good && i < exports; ++i) part[export_local[i]] = export_parts[i];
    Zoltan_LB_Free_Part(&import_ids, &import_local, &import_ranks, &import_parts);
    Zoltan_LB_Free_Part(&export_ids, &export_local, &export_ranks, &export_parts);
    return good;
  }

 private:
  bool set(const char* name, const char* value) {
    return Zoltan_Set_Param(zoltan_, name, value) == ZOLTAN_OK;
  }

  Zoltan_Struct* zoltan_ = nullptr;
  bool good_ = false;
};

}  // namespace

std::vector<std::int32_t> partition(const Comm& comm, PartitionMethod method,
                                    const PartitionObjects& objects) {
  collectively(comm, "partitioning", [&] {
    const std::size_t count = objects.id.size();
    check(objects.point.size() == count, "one point per object");
    check(count <= static_cast<std::size_t>(std::numeric_limits<int>::max()), "too many objects on a rank");
    check(method != PartitionMethod::kGraph || (objects.first.size() == count + 1 &&
                                                objects.neighbour.size() == objects.neighbour_rank.size()),
          "neighbours of each object");
  });
  std::vector<std::int32_t> part(objects.id.size(), 0);
  if (comm.size() == 1) return part;
  const Holders holders(comm, !part.empty());
  bool good = true;
  if (!part.empty()) {
    std::vector<std::int32_t> neighbour_rank;
    for (const std::int32_t rank : objects.neighbour_rank) neighbour_rank.push_back(holders.number(rank));
    PartitionObjects there = objects;
    there.neighbour_rank = neighbour_rank;
    Zoltan zoltan(holders.handle(), comm.size(), method, there);
    good = zoltan.good() && zoltan.run(part);
  }
  for (const std::int32_t p : part) good = good && p >= 0 && p < comm.size();
  if (comm.min(std::int64_t{good}) == 0)
    throw AgreedError(fmt::format(
        "Zoltan could not partition the elements with method {}; try another method", name_of(method)));
  return part;
}

}  // namespace sculpt
