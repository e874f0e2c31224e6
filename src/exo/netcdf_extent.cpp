#include "exo/netcdf_extent.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

// A walk through the header of a classic file. All integers are big-endian; `wide` ones have 8 bytes in
// CDF-5.
class HeaderWalk {
 public:
  HeaderWalk(std::ifstream& file, const std::string& path, int version)
      : file_(file), path_(path), version_(version) {}

  std::int64_t least_length() {
    records_ = integer(version_ == 5 ? 8 : 4);
    if (version_ != 5 && records_ == 0xFFFFFFFF) records_ = 0;  // a stream: the number was never filled in
    read_dimensions();
    skip_attributes();
    read_variables();
    if (record_variables_ == 1) record_bytes_ = single_record_bytes_;  // a lone one is not padded
    std::int64_t end = std::max(end_, static_cast<std::int64_t>(file_.tellg()));
    if (records_ > 0 && record_variables_ > 0)
      end = std::max(end, last_record_end_ + (records_ - 1) * record_bytes_);
    return end;
  }

 private:
  [[noreturn]] void damaged(const char* why) const {
    throw Error(fmt::format("'{}' is not a complete netCDF file: {}", path_, why));
  }
  std::int64_t integer(int bytes) {
    unsigned char raw[8] = {};
    file_.read(reinterpret_cast<char*>(raw), bytes);
    if (!file_) damaged("it ends inside its header");
    std::uint64_t value = 0;
    for (int b = 0; b < bytes; ++b) value = value << 8 | raw[b];
    return static_cast<std::int64_t>(value);
  }
  std::int64_t wide() {
    const std::int64_t value = integer(version_ == 5 ? 8 : 4);
    if (value < 0) damaged("a number in its header is negative");
    return value;
  }
  void skip(std::int64_t bytes) {
    if (bytes < 0 || bytes > (std::int64_t{1} << 32)) damaged("a length in its header is out of range");
    file_.ignore((bytes + 3) / 4 * 4);
    if (!file_) damaged("it ends inside its header");
  }
  void skip_name() { skip(wide()); }
  // Number of entries of a list that must carry this tag, or be absent.
  std::int64_t list(std::int64_t tag) {
    const std::int64_t found = integer(4);
    const std::int64_t count = wide();
    if (found != tag && (found != 0 || count != 0)) damaged("its header is damaged");
    return count;
  }
  std::int64_t type_bytes(std::int64_t type) const {
    static constexpr std::int64_t kBytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    if (type < 1 || type > 11) damaged("its header is damaged");
    return kBytes[type];
  }
  void read_dimensions() {
    for (std::int64_t n = list(10); n > 0; --n) {
      skip_name();
      dimensions_.push_back(wide());
    }
  }
  void skip_attributes() {
    for (std::int64_t n = list(12); n > 0; --n) {
      skip_name();
      const std::int64_t bytes = type_bytes(integer(4));
      skip(wide() * bytes);
    }
  }
  void read_variables() {
    for (std::int64_t n = list(11); n > 0; --n) {
      skip_name();
      bool record = false;
      double exact = 1;  // guards against a product that does not fit
      std::int64_t bytes = 1;
      const std::int64_t rank = wide();
      for (std::int64_t d = 0; d < rank; ++d) {
        const std::int64_t dimension = wide();
        if (dimension >= static_cast<std::int64_t>(dimensions_.size())) damaged("its header is damaged");
        const std::int64_t length = dimensions_[static_cast<std::size_t>(dimension)];
        if (length == 0 && d == 0) {
          record = true;
          continue;
        }
        exact *= static_cast<double>(length);
        if (exact > 1e17) damaged("a dimension in its header is out of range");
        bytes *= length;
      }
      skip_attributes();
      bytes *= type_bytes(integer(4));
      wide();  // the length field is capped at 4 GB, hence computed here
      note(record, integer(version_ == 1 ? 4 : 8), bytes);
    }
  }
  void note(bool record, std::int64_t begin, std::int64_t bytes) {
    if (!record) {
      end_ = std::max(end_, begin + bytes);
      return;
    }
    ++record_variables_;
    single_record_bytes_ = bytes;
    record_bytes_ += (bytes + 3) / 4 * 4;
    last_record_end_ = std::max(last_record_end_, begin + bytes);
  }

  std::ifstream& file_;
  const std::string& path_;
  int version_;
  std::vector<std::int64_t> dimensions_;  // 0 = the record dimension
  std::int64_t records_ = 0, record_variables_ = 0, record_bytes_ = 0, single_record_bytes_ = 0;
  std::int64_t end_ = 0, last_record_end_ = 0;
};

// The end of the file as the HDF5 superblock has it; 0 when it has an unknown layout. Little-endian.
std::int64_t hdf5_length(std::ifstream& file) {
  unsigned char block[64] = {};
  file.clear();
  file.seekg(0);
  file.read(reinterpret_cast<char*>(block), sizeof block);
  const int version = block[8];
  if (file.gcount() < 48 || version > 3 || block[version < 2 ? 13 : 9] != 8) return 0;
  const std::size_t at = version == 0 ? 40 : version == 1 ? 44 : 28;
  std::uint64_t length = 0;
  for (std::size_t b = 8; b-- > 0;) length = length << 8 | block[at + b];
  return static_cast<std::int64_t>(length);
}

}  // namespace

NetcdfExtent netcdf_extent(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(fmt::format("cannot open '{}': {}", path, std::strerror(errno)));
  char magic[4] = {};
  file.read(magic, 4);
  if (file.gcount() == 4 && std::memcmp(magic, "\211HDF", 4) == 0)
    return {NetcdfExtent::kHdf5, hdf5_length(file)};
  const bool classic = file.gcount() == 4 && std::memcmp(magic, "CDF", 3) == 0 &&
                       (magic[3] == 1 || magic[3] == 2 || magic[3] == 5);
  if (!classic) return {};
  return {NetcdfExtent::kClassic, HeaderWalk(file, path, magic[3]).least_length()};
}

}  // namespace sculpt
