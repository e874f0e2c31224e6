#pragma once
// How long a netCDF file must be, from its own header. The netCDF library reads zeros behind the end of a
// classic file that was cut off (a copy that broke, a full disk), so the length is checked before anything is
// believed.
#include <cstdint>
#include <string>

namespace sculpt {

struct NetcdfExtent {
  enum Kind {
    kForeign,  // neither netCDF nor HDF5
    kClassic,  // CDF-1, CDF-2 or CDF-5
    kHdf5,     // netCDF-4
  };
  Kind kind = kForeign;
  std::int64_t bytes = 0;  // the least length of a complete file; 0 = not known
};

// Throws Error when the file cannot be read or ends inside its header.
[[nodiscard]] NetcdfExtent netcdf_extent(const std::string& path);

}  // namespace sculpt
