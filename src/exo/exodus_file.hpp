#pragma once
// An open Exodus file: closed by its destructor, and every library code becomes an Error that names the file,
// what was being done and why it failed. The only header with exodusII.h. Not thread safe, as the library.
#include <exodusII.h>

#include <cstdint>
#include <string>

namespace sculpt {

class ExodusFile {
 public:
  // How a file stores numbers; create() says what for.
  struct Format {
    bool netcdf4 = false;  // variables above 4 GB
    bool int64 = false;    // ids and counts above 2^31-1; implies netCDF-4
  };

  // Creates or replaces the file.
  static ExodusFile create(const std::string& path, Format format);
  // Opens for reading. Throws Error when the file is missing, no Exodus file, damaged or cut short.
  static ExodusFile open(const std::string& path);

  ExodusFile(ExodusFile&& other) noexcept : path_(std::move(other.path_)), id_(other.id_) { other.id_ = -1; }
  ExodusFile& operator=(ExodusFile&&) = delete;
  ~ExodusFile();

  [[nodiscard]] int id() const { return id_; }
  [[nodiscard]] const std::string& path() const { return path_; }  // as messages show it

  // The integers that the void_int arguments of the next calls point to: 64 bits, or 32.
  void use_int64();
  void use_int32();

  // Judges the return value of a library call: must(ex_put_coord(...), "writing the coordinates").
  void must(int status, const char* doing) const;
  // Closes a written file and waits until its bytes are on the disk, which is where a full one shows at last.
  void close_written();

 private:
  ExodusFile(std::string path, int id);

  std::string path_;
  int id_ = -1;
};

}  // namespace sculpt
