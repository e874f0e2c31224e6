#include "exo/exodus_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "exo/netcdf_extent.hpp"
#include "sculpt/base/error.hpp"
#include "sculpt/exo/write_rank_file.hpp"

namespace sculpt {
namespace {

constexpr int kDoubles = 8;  // word size of the coordinates in memory and on disk

// What the library's codes mean: positive ones are errno or Exodus's own, negative ones are netCDF's.
std::string code_text(int code) {
  switch (code) {
    case EX_MEMFAIL:
      return "out of memory";
    case EX_BADFILEID:
      return "bad file handle";
    case EX_WRONGFILETYPE:
      return "not an Exodus file";
    case EX_LOOKUPFAIL:
      return "id not found in the file";
    case EX_BADPARAM:
      return "bad parameter";
    case -31:
    case -36:
      return "data damaged or cut short";
    case -38:
      return "netCDF refuses to define data now";
    case -40:
      return "index beyond the data";
    case -46:
      return "two things have the same id";
    case -51:
      return "not a netCDF file";
    case -60:
      return "a number is out of the range of its type";
    case -61:
      return "out of memory";
    case -62:
      return "a variable is larger than the format allows";
    case -101:
    case -102:
    case -103:
    case -104:
    case -105:
    case -106:
      return "HDF5 failure";
    default:
      break;
  }
  if (code > 0 && code < 1000) return std::strerror(code);
  return fmt::format("library error {}", code);
}

// The cause of the failure that a library call has just reported.
std::string cause(int status) {
  const int system_error = errno;
  const char* message = nullptr;
  const char* function = nullptr;
  int code = 0;
  ex_get_err(&message, &function, &code);
  if (code == 0) code = status;
  std::string text = code_text(code);
  const bool told_by_system = code > 0 && code < 1000;
  if (!told_by_system && (system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG ||
                          system_error == EIO || system_error == EACCES))
    text = std::strerror(system_error);
  return text;
}

// Refuses, with a reason of its own, what the library would report in riddles or not at all: netCDF reads
// zeros where a classic file has been cut off.
void look_at_bytes(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    throw Error(fmt::format("cannot open '{}': {}", path, std::strerror(errno)));
  if (S_ISDIR(info.st_mode))
    throw Error(fmt::format("cannot read '{}': it is a folder, expected an Exodus file", path));
  const NetcdfExtent extent = netcdf_extent(path);
  if (extent.kind == NetcdfExtent::kForeign)
    throw Error(fmt::format(
        "'{}' is not an Exodus file: its first bytes are neither those of netCDF nor of HDF5", path));
  if (extent.bytes > static_cast<std::int64_t>(info.st_size))
    throw Error(fmt::format("'{}' is cut short: its header describes {} bytes, the file has {}", path,
                            extent.bytes, static_cast<std::int64_t>(info.st_size)));
}

}  // namespace

ExodusFile::ExodusFile(std::string path, int id) : path_(std::move(path)), id_(id) { errno = 0; }

// Formats. The default, netCDF-3 with 64-bit offsets (what Sculpt writes), allows 2^32-4 bytes per variable
// and 32-bit integers; it is by far the fastest with many blocks. NetCDF-4 lifts both limits.
ExodusFile ExodusFile::create(const std::string& path, Format format) {
  ex_opts(0);  // the library is not to talk to the user; cause() does
  int mode = EX_CLOBBER | EX_ALL_INT64_API;
  if (format.int64)
    mode |= EX_ALL_INT64_DB | EX_NETCDF4;
  else
    mode |= format.netcdf4 ? EX_NETCDF4 : EX_LARGE_MODEL;
  int memory = kDoubles, disk = kDoubles;
  errno = 0;
  const int id = ex_create(path.c_str(), mode, &memory, &disk);
  if (id < 0) throw Error(fmt::format("cannot create '{}': {}", shown_name(path), cause(id)));
  return {shown_name(path), id};
}

ExodusFile ExodusFile::open(const std::string& path) {
  look_at_bytes(path);
  ex_opts(0);
  int memory = kDoubles, disk = 0;
  float version = 0;
  errno = 0;
  const int id = ex_open(path.c_str(), EX_READ | EX_ALL_INT64_API, &memory, &disk, &version);
  if (id < 0)
    throw Error(
        fmt::format("'{}' cannot be read as an Exodus file ({}); it is damaged, cut short, or a netCDF file "
                    "of another kind",
                    path, cause(id)));
  return {path, id};
}

ExodusFile::~ExodusFile() {
  if (id_ >= 0) ex_close(id_);
}

void ExodusFile::use_int64() { ex_set_int64_status(id_, EX_ALL_INT64_API); }
void ExodusFile::use_int32() { ex_set_int64_status(id_, 0); }

void ExodusFile::must(int status, const char* doing) const {
  if (status < 0) throw Error(fmt::format("'{}', {}: {}", path_, doing, cause(status)));
  errno = 0;
}

void ExodusFile::close_written() { must(ex_close(std::exchange(id_, -1)), "closing the file"); }

}  // namespace sculpt
